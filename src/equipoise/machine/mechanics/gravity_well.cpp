// Depth of the well, from the energy, the motor's torque at rest and the adjacent maxima of gravity's potential.
#include "equipoise/machine/mechanics/gravity_well.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/drives/full_state.hpp"
#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/model/held_state.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/unbalance.hpp"

namespace equipoise::model {

namespace {

std::optional<double> torque_at_rest(const System& system) {
  const DriveSegment& motor = system.drive().motor;
  if (system.section() != Section::turn || motor.slope > 0.0 || motor.integral != 0.0) return std::nullopt;
  // A load only brakes. For a characteristic, so must all points and the line after the last.
  const double rest = motor.motor_torque(motor.begin, 0.0, 0.0);
  double slope = motor.slope;
  for (int k = 0; k < motor.bends.count; ++k) {
    slope += motor.bends.by[k];
    const double speed = motor.bends.at[k];
    if ((motor.motor_torque(motor.begin, speed, 0.0) - rest) * speed > 0.0) return std::nullopt;
  }
  if (slope > 0.0) return std::nullopt;
  return rest;
}

bool holds_against(std::complex<double> moment, double torque) { return std::abs(moment) > std::fabs(torque); }

// Two balls that replace all held balls, with the same mass, centre of mass and moment of inertia.
struct Twin {
  Parameters parameters;
  std::array<double, machine_layout(2).size> state{};
};

Twin twin_of(const System& system, const double* held) {
  const Parameters& p = system.parameters();
  const double mass = p.total_mass();
  double spin = 0.0;  // from balls that turn with the rotor
  for (int i = 0; i < p.balls; ++i) spin += p.mass[i] * p.ball_radius[i] * p.ball_radius[i];
  Twin twin{p};
  twin.parameters.balls = 2;
  twin.parameters.mass = {0.5 * mass, 0.5 * mass};
  twin.parameters.ball_radius.fill(std::sqrt(spin / mass));
  const std::complex<double> sum(held[4], held[5]);
  const double apart = std::acos(std::min(1.0, std::abs(sum) / mass));
  std::copy_n(held, 4, twin.state.begin());
  twin.state[index::phi(0)] = std::arg(sum) + apart;
  twin.state[index::phi(1)] = std::arg(sum) - apart;
  copy_drive(held_layout(system), held, machine_layout(2), twin.state.data());
  return twin;
}

}  // namespace

// `balls`: least potential energy of the balls that do not turn with the rotor.
GravityWell::GravityWell(const System& system, std::complex<double> moment, double torque, double balls)
    : system_(system), moment_(moment), torque_(torque), angle_(std::acos(torque / std::abs(moment))) {
  const Parameters& p = system.parameters();
  const double weight = (1.0 + p.total_mass()) * p.gravity;
  const double lower = torque < 0.0 ? angle_ - two_pi : angle_;
  top_ = std::abs(moment) * std::sin(angle_) - torque * (lower - std::arg(moment)) + balls -
         0.5 * weight * weight / p.stiffness[1];
}

std::optional<GravityWell> GravityWell::of(const System& system) {
  const Parameters& p = system.parameters();
  if (p.tilts()) return std::nullopt;  // its energy is another
  const double mass = p.total_mass();
  const std::complex<double> moment =
      p.gravity * (p.eccentricity + mass * std::complex<double>(p.race_offset[0], p.race_offset[1]));
  const auto torque = torque_at_rest(system);
  if (!torque || !holds_against(moment, *torque)) return std::nullopt;
  return GravityWell(system, moment, *torque, -p.gravity * mass);
}

double GravityWell::level(const double* state) const {
  const Parameters& p = system_.parameters();
  std::array<double, largest_state> reduced{};
  copy_state(system_.layout(), state, machine_layout(p.balls), reduced.data());
  double& psi = reduced[machine_layout(p.balls).psi];
  psi -= two_pi * (1.0 + std::floor((psi + std::arg(moment_) - angle_) / two_pi));
  return full_energy(p, reduced.data()) - torque_ * psi;
}

bool GravityWell::holds(const double* state) const { return level(state) < top_; }

// With one ball at its top, the energy is least if everything else is at the bottom.
bool GravityWell::holds_balls(const double* state) const {
  const Parameters& p = system_.parameters();
  const double lightest = *std::min_element(p.mass.begin(), p.mass.begin() + p.balls);
  return level(state) < level(bottom().data()) + 2.0 * p.gravity * lightest;
}

Eigen::VectorXd GravityWell::bottom() const {
  const Parameters& p = system_.parameters();
  Eigen::VectorXd state = Eigen::VectorXd::Zero(system_.dimension());
  const double psi = -angle_ - std::arg(moment_);
  const auto rest = rest_position(p, psi);
  std::copy(rest.begin(), rest.end(), state.begin());
  state.segment(index::phi(0), p.balls).setConstant(-0.5 * pi - psi);
  state[system_.layout().psi] = psi;
  return system_.with_angles_reduced(state);
}

bool trapped_in_well(const System& system, const double* held, double speed) {
  const auto torque = torque_at_rest(system);
  if (!torque) return false;
  const Twin twin = twin_of(system, held);
  const std::complex<double> moment = twin.parameters.gravity * unbalance(twin.parameters, &twin.state[index::phi(0)]);
  if (!holds_against(moment, *torque)) return false;
  const GravityWell well(System(twin.parameters, system.drive()), moment, *torque, 0.0);
  std::array<double, machine_layout(2).size> lowest{};
  const Eigen::VectorXd bottom = well.bottom();
  std::copy_n(bottom.begin(), 4, lowest.begin());
  std::copy_n(&twin.state[index::phi(0)], 2, &lowest[index::phi(0)]);
  lowest[machine_layout(2).psi] = bottom[machine_layout(2).psi];
  const double left = well.level(twin.state.data()) - well.level(lowest.data());
  return well.holds(twin.state.data()) && 2.0 * left < twin.parameters.inertia * speed * speed;
}

}  // namespace equipoise::model
