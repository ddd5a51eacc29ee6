// Energy and its balance. The residual along a trajectory is the sharpest check on both energy and equations.
#include "equipoise/mechanics/energy.hpp"

#include <cmath>

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

double full_energy(const Parameters& p, const double* z) {
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
