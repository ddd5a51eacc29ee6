// Energy and its balance. The residual along a trajectory is the sharpest check on both energy and equations.
#include "equipoise/machine/mechanics/energy.hpp"

#include <cmath>
#include <cstddef>

#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/energy-inl.hpp"
#include "equipoise/machine/model/equations-inl.hpp"
#include "equipoise/machine/model/state_layout.hpp"

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

kernels::RotorMotion<double> motion_of(const StateLayout& at, const double* z) {
  return {z[at.speed], 0.0, std::sin(z[at.psi]), std::cos(z[at.psi])};
}

}  // namespace

Powers tilting_powers(const Parameters& p, double torque, bool held, const double* z) {
  const StateLayout at = machine_layout(p);
  return {torque * z[at.speed], kernels::TiltEnergy<double>(p, at.tilt).taken_by_supports(motion_of(at, z), z),
          held ? 0.0 : kernels::RotorEnergy<double>(p).taken_by_drag(z)};
}

double full_energy(const Parameters& p, const double* z) {
  const StateLayout at = machine_layout(p);
  if (p.tilts()) return kernels::TiltEnergy<double>(p, at.tilt).stored(motion_of(at, z), z);
  return kernels::RotorEnergy<double>(p).stored(motion_of(at, z), z);
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
