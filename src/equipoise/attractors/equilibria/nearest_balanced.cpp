// Members of a continuum of balanced states.
#include "equipoise/attractors/equilibria/nearest_balanced.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "equipoise/attractors/motions/motion_description.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

namespace {

BalancedMember equilibrium_member(const model::System& system, const Eigen::VectorXd& centre) {
  const int freedom = model::balanced_freedom(system);
  Equilibrium balanced;
  balanced.state = centre;
  balanced.eigenvalues = dense::eigenvalues(model::jacobian(system, centre));
  std::sort(balanced.eigenvalues.begin(), balanced.eigenvalues.end(),
            [](const auto& a, const auto& b) { return a.real() > b.real(); });
  balanced.residual = model::rate(system, centre).cwiseAbs().maxCoeff();
  BalancedMember member{centre, balanced, -1.0, attracts(balanced.eigenvalues, freedom)};
  for (const auto& value : balanced.eigenvalues)
    if (std::abs(value) >= zero_eigenvalue) member.rate = std::max(member.rate, value.real());
  return member;
}

BalancedMember orbit_member(const model::System& system, const PeriodicOrbit& orbit) {
  const int freedom = model::balanced_freedom(system);
  const Eigen::VectorXcd decays = orbit.decays();
  const double rate = std::log(std::max(1e-300, std::abs(decays[freedom]))) / orbit.period;
  return {orbit.nodes[0], orbit, rate, contracts(decays, freedom)};
}

std::optional<BalancedMember> member_on_section(const model::System& system, const Eigen::VectorXd& centre,
                                                double reach) {
  const auto orbit = refine_orbit(system, std::vector{centre}, system.section_period(), reach);
  return orbit ? std::optional(orbit_member(system, *orbit)) : std::nullopt;
}

// Under a motor: only the rotor's angle changes. Exact without gravity and with a centred race.
std::optional<BalancedMember> turning_member(const model::System& system, const Eigen::VectorXd& centre) {
  const double speed = system.speed(centre);
  PeriodicOrbit orbit;
  orbit.period = system.section_angle() / std::fabs(speed);
  orbit.winding[static_cast<std::size_t>(system.balls())] = speed > 0.0 ? 1 : -1;
  orbit.nodes = {centre};
  constexpr double tolerance = 1e-12;
  const auto arcs = follow_arcs(system, orbit.nodes, orbit.period, tolerance);
  if (arcs.empty()) return std::nullopt;
  orbit.multipliers = floquet_multipliers(system, orbit.nodes, arcs);
  return orbit_member(system, orbit);
}

}  // namespace

std::optional<BalancedMember> nearest_balanced(const model::System& system, const Eigen::VectorXd& state,
                                               double reach) {
  const auto speed = system.coasts() ? std::optional(system.speed(state)) : model::balanced_speed(system);
  if (!speed || (*speed == 0.0 && !system.prescribed())) return std::nullopt;
  double phi[model::max_balls];
  for (int i = 0; i < system.balls(); ++i) phi[i] = state[model::index::phi(i)];
  if (!model::project_to_balanced(system, *speed, phi)) return std::nullopt;
  Eigen::VectorXd centre = model::balanced_state(system, *speed, phi);
  if (system.layout().psi >= 0) centre[system.layout().psi] = state[system.layout().psi];
  switch (system.section()) {
    case model::Section::stroboscopic:
      return member_on_section(system, centre, reach);
    case model::Section::turn:
      return turning_member(system, centre);
    default:
      return equilibrium_member(system, centre);
  }
}

Motion describe(const model::System& system, const BalancedMember& member) {
  const auto* orbit = std::get_if<PeriodicOrbit>(&member.refined);
  return orbit ? describe_orbit(system, *orbit) : describe_equilibrium(system, std::get<Equilibrium>(member.refined));
}

}  // namespace equipoise
