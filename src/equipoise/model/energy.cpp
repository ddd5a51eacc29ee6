// Energy balance beside the equations: its residual along a trajectory is the sharpest check on both.
#include "equipoise/model/energy.hpp"

#include <cmath>

#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/equations-inl.hpp"
#include "equipoise/model/frames.hpp"

namespace equipoise::model {

namespace {
namespace kernels = HWY_NAMESPACE;

kernels::RotorMotion<double> motion_at(const Segment& s, double t) {
  const double psi = s.psi_at(t);
  return {s.speed_at(t), s.acceleration, std::sin(psi), std::cos(psi)};
}
}  // namespace

namespace {

// With the balls' race centred at `offset` from O.
double energy_at(const Parameters& p, double inertia, const std::array<double, 2>& offset,
                 const kernels::RotorMotion<double>& rotor, const double* z) {
  const double w = rotor.speed, lambda = p.eccentricity;
  const double x = z[index::x], y = z[index::y], u = z[index::u], v = z[index::v];
  const auto [X, Y] = in_fixed_axes(rotor.cos_psi, rotor.sin_psi, x, y);
  double e = 0.5 * inertia * w * w + 0.5 * (u * u + (v + lambda * w) * (v + lambda * w)) +
             0.5 * p.stiffness[0] * X * X + 0.5 * p.stiffness[1] * Y * Y + p.gravity * (Y + lambda * rotor.sin_psi);
  for (int i = 0; i < p.balls; ++i) {
    const double phi = z[index::phi(i)], rate = w + z[index::q(i, p.balls)];
    const double s = std::sin(phi), c = std::cos(phi);
    const double vx = u - w * offset[1] - rate * s, vy = v + w * offset[0] + rate * c;
    const double height = Y + rotor.sin_psi * (offset[0] + c) + rotor.cos_psi * (offset[1] + s);
    e += p.mass[i] * (0.5 * (vx * vx + vy * vy) + p.gravity * height);
    if (!p.rolls) continue;
    const double rim = p.ball_radius[i] * w - z[index::q(i, p.balls)];  // radius times spin, from where it touches
    e += 0.5 * sphere_inertia.value() * p.mass[i] * rim * rim;
  }
  return e;
}

}  // namespace

double energy(const Parameters& p, double inertia, const Segment& segment, double t, const double* z) {
  return energy_at(p, inertia, {0.0, 0.0}, motion_at(segment, t), z);
}

double machine_energy(const Parameters& p, const double* z) {
  const double psi = z[machine_index::psi(p.balls)];
  return energy_at(p, p.inertia, p.race_offset, {z[machine_index::speed(p.balls)], 0.0, std::sin(psi), std::cos(psi)},
                   z);
}

Powers powers(const Parameters& p, double inertia, const Segment& segment, double t, const double* z) {
  Parameters rotor_with_inertia = p;
  rotor_with_inertia.inertia = inertia;
  const kernels::BallBalancer<double, any_count, kernels::Terms{true, true, true, true, true}> balancer(
      rotor_with_inertia);
  const auto rotor = motion_at(segment, t);
  kernels::BallActions<double, any_count> actions;
  double drag_power = 0.0, dz[dimension(max_balls)];
  for (int i = 0; i < p.balls; ++i) {
    const double q = z[index::q(i, p.balls)];
    actions.held[i] = segment.clamped;
    if (!segment.clamped) drag_power += p.mass[i] * p.drag[i] * q * q;
  }
  const double torque = balancer.machine_derivative(rotor, actions, nullptr, z, dz).torque;
  const auto [Xd, Yd] = in_fixed_axes(rotor.cos_psi, rotor.sin_psi, z[index::u], z[index::v]);
  return Powers{torque * rotor.speed, p.damping[0] * Xd * Xd + p.damping[1] * Yd * Yd, drag_power};
}

std::array<double, 2> bearing_force(const Parameters& p, double psi, const double* z) {
  const kernels::BallBalancer<double, 1, kernels::Terms{}> balancer(p);
  const kernels::RotorMotion<double> rotor{0.0, 0.0, std::sin(psi), std::cos(psi)};
  const auto f = balancer.bearing_force(rotor, z);
  return in_fixed_axes(rotor.cos_psi, rotor.sin_psi, f.x, f.y);
}

}  // namespace equipoise::model
