// Members of a continuum of balanced states.
#include "equipoise/motions/nearest_balanced.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "equipoise/math/dense.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/motions/motion_description.hpp"

namespace equipoise {

namespace {

BalancedMember equilibrium_member(const model::System& system, const Eigen::VectorXd& centre) {
  const int dimension = continuum_dimension(system.parameters());
  Equilibrium balanced;
  balanced.state = centre;
  balanced.eigenvalues = dense::eigenvalues(model::jacobian(system, centre));
  std::sort(balanced.eigenvalues.begin(), balanced.eigenvalues.end(),
            [](const auto& a, const auto& b) { return a.real() > b.real(); });
  balanced.residual = model::rate(system, centre).cwiseAbs().maxCoeff();
  BalancedMember member{centre, balanced, -1.0, attracts(balanced.eigenvalues, dimension)};
  for (const auto& value : balanced.eigenvalues)
    if (std::abs(value) >= zero_eigenvalue) member.rate = std::max(member.rate, value.real());
  return member;
}

std::optional<BalancedMember> strobed_member(const model::System& system, const Eigen::VectorXd& centre, double reach) {
  const int dimension = continuum_dimension(system.parameters());
  const auto orbit = refine_orbit(system, std::vector{centre}, system.strobe_period(), reach);
  if (!orbit) return std::nullopt;
  const double rate = std::log(std::max(1e-300, std::abs(orbit->multipliers[dimension]))) / orbit->period;
  return BalancedMember{orbit->nodes[0], *orbit, rate, contracts(orbit->multipliers, dimension)};
}

}  // namespace

std::optional<BalancedMember> nearest_balanced(const model::System& system, const Eigen::VectorXd& state,
                                               double reach) {
  double phi[model::max_balls];
  for (int i = 0; i < system.balls(); ++i) phi[i] = state[model::index::phi(i)];
  if (!model::project_to_balanced(system.parameters(), phi)) return std::nullopt;
  const Eigen::VectorXd centre = model::centred_state(system.parameters(), phi);
  if (system.section() == model::Section::strobe) return strobed_member(system, centre, reach);
  return equilibrium_member(system, centre);
}

Motion describe(const model::System& system, const BalancedMember& member) {
  const auto* orbit = std::get_if<PeriodicOrbit>(&member.refined);
  return orbit ? describe_orbit(system, *orbit) : describe_equilibrium(system, std::get<Equilibrium>(member.refined));
}

}  // namespace equipoise
