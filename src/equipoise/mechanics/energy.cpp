// Energy and its balance. The residual along a trajectory is the sharpest check on both energy and equations.
#include "equipoise/mechanics/energy.hpp"

#include <cmath>
#include <cstddef>

#include "equipoise/mechanics/frames.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/energy-inl.hpp"
#include "equipoise/model/equations-inl.hpp"
#include "equipoise/model/state_layout.hpp"

namespace equipoise::model {

namespace {
namespace kernels = HWY_NAMESPACE;

kernels::RotorMotion<double> motion_at(const Segment& s, double t) {
  const double psi = s.psi_at(t);
  return {s.speed_at(t), s.acceleration_at(t), std::sin(psi), std::cos(psi)};
}

Parameters with_inertia(Parameters p, double inertia) {
  p.inertia = inertia;
  return p;
}
}  // namespace

double energy(const Parameters& p, double inertia, const Segment& segment, double t, const double* z) {
  return kernels::RotorEnergy<double>(with_inertia(p, inertia)).stored(motion_at(segment, t), z);
}

namespace {

double square(const std::array<double, 2>& v) { return v[0] * v[0] + v[1] * v[1]; }

// docs/explanation/equations.md, "A rotor that tilts". Velocities along the turning axes, springs in fixed axes.
double tilting_energy(const Parameters& p, const double* z) {
  const StateLayout at = machine_layout(p);
  const double *tilt = z + at.tilt, w = z[at.speed], psi = z[at.psi], c = std::cos(psi), s = std::sin(psi);
  const double lambda_x = p.eccentricity * std::cos(p.eccentricity_angle),
               lambda_y = p.eccentricity * std::sin(p.eccentricity_angle);
  const auto centre = in_fixed_axes(c, s, z[index::x], z[index::y]), slope = in_fixed_axes(c, s, tilt[0], tilt[1]);
  double e = 0.5 * (square({z[index::u] - w * lambda_y, z[index::v] + w * lambda_x}) + p.inertia * w * w +
                    p.tilt.transverse_inertia * square({tilt[2], tilt[3]})) +
             w * p.tilt.couple() * tilt[3] + p.gravity * (centre[1] + lambda_x * s + lambda_y * c);
  for (const std::size_t d : {0, 1})
    e += 0.5 * (p.stiffness[d] * centre[d] * centre[d] + p.tilt.stiffness[d][1] * slope[d] * slope[d]) +
         p.tilt.stiffness[d][0] * centre[d] * slope[d];
  for (int i = 0; i < p.balls; ++i) {
    const double place = p.tilt.plane[i], phi = z[index::phi(i)], rate = w + z[index::q(i, p.balls)];
    const std::array<double, 2> velocity{z[index::u] + place * tilt[2] - rate * std::sin(phi),
                                         z[index::v] + place * tilt[3] + rate * std::cos(phi)};
    e += p.mass[i] * (0.5 * square(velocity) + p.gravity * (centre[1] + place * slope[1] + std::sin(psi + phi)));
  }
  return e;
}

}  // namespace

Powers tilting_powers(const Parameters& p, double torque, bool held, const double* z) {
  const StateLayout at = machine_layout(p);
  const auto v = in_fixed_axes(std::cos(z[at.psi]), std::sin(z[at.psi]), z[index::u], z[index::v]);
  const double of_centre = p.damping[0] * v[0] * v[0] + p.damping[1] * v[1] * v[1];
  return {torque * z[at.speed], of_centre + power_taken_from_tilt(p, z[at.psi], z, z + at.tilt),
          held ? 0.0 : kernels::RotorEnergy<double>(p).taken_by_drag(z)};
}

double full_energy(const Parameters& p, const double* z) {
  if (p.tilts()) return tilting_energy(p, z);
  const double psi = z[machine_layout(p.balls).psi];
  return kernels::RotorEnergy<double>(p).stored({z[machine_layout(p.balls).speed], 0.0, std::sin(psi), std::cos(psi)},
                                                z);
}

Powers powers(const Parameters& p, double inertia, const Segment& segment, double t, const double* z) {
  const kernels::BallBalancer<double, any_count, kernels::Terms{true, true, true, true, true}> balancer(
      with_inertia(p, inertia));
  const kernels::RotorEnergy<double> energies(p);
  const auto rotor = motion_at(segment, t);
  kernels::BallActions<double, any_count> actions;
  double dz[dimension(max_balls)];
  for (int i = 0; i < p.balls; ++i) actions.held[i] = segment.clamped;
  const double torque = balancer.full_derivative(rotor, actions, nullptr, z, dz).torque;
  return Powers{torque * rotor.speed, energies.taken_by_supports(rotor, z),
                segment.clamped ? 0.0 : energies.taken_by_drag(z)};
}

double power_taken_from_tilt(const Parameters& p, double psi, const double* z, const double* tilt) {
  const double c = std::cos(psi), s = std::sin(psi);
  const auto centre = in_fixed_axes(c, s, z[index::u], z[index::v]), slope = in_fixed_axes(c, s, tilt[2], tilt[3]);
  double power = 0.0;
  for (const std::size_t d : {0, 1})
    power += slope[d] * (2.0 * p.tilt.damping[d][0] * centre[d] + p.tilt.damping[d][1] * slope[d]);
  return power;
}

std::array<double, 2> bearing_force(const Parameters& p, double psi, const double* z, const double* tilt) {
  const kernels::BallBalancer<double, 1, kernels::Terms{}> balancer(p);
  const kernels::RotorMotion<double> rotor{0.0, 0.0, std::sin(psi), std::cos(psi)};
  auto f = balancer.bearing_force(rotor, z);
  if (tilt) {
    const std::array<double, 8> both{z[0], z[1], z[2], z[3], tilt[0], tilt[1], tilt[2], tilt[3]};
    kernels::TiltConstants<double, 1>(p, 4).add_supports(rotor, both.data(), f);
  }
  return in_fixed_axes(rotor.cos_psi, rotor.sin_psi, f.x, f.y);
}

}  // namespace equipoise::model
