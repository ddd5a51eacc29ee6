// Tables for lanes, and functions for single states.
#include "equipoise/traps/trap_rule.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "equipoise/model/unbalance.hpp"
#include "equipoise/orbits/stroboscopic.hpp"

namespace equipoise {

namespace {

// Velocities, x, y and imbalance are all below the reach of what the continuum holds.
bool in_reach(const model::Parameters& p, const ContinuumTrap& trap, const double* state) {
  double away = std::abs(model::unbalance(p, state + model::index::phi(0)));
  for (int i = 0; i < 4; ++i) away = std::max(away, std::fabs(state[i]));
  for (int i = 0; i < p.balls; ++i) away = std::max(away, std::fabs(state[model::index::q(i, p.balls)]));
  return away < trap.reach;
}

FamilyTrap family_of(const ContinuumTrap& trap, int size) {
  return {trap.reach,
          [trap, size](const double* state) { return trap.holds(Eigen::Map<const Eigen::VectorXd>(state, size)); }};
}

// With what gravity leaves of a continuum the same is asked of the state at the next strobe.
std::function<bool(const double*, double)> strobed_family(const model::System& system, const ContinuumTrap& trap) {
  return [system, trap](const double* state, double psi) {
    if (!in_reach(system.parameters(), trap, state)) return false;
    const auto at_strobe = at_next_strobe(system, Eigen::Map<const Eigen::VectorXd>(state, system.dimension()), psi);
    return at_strobe && trap.holds(*at_strobe);
  };
}

StrobedTraps strobed_traps(const model::System& system, const CycleTraps& cycles,
                           const std::optional<ContinuumTrap>& continuum) {
  if (cycles.empty() && !continuum) return {};
  std::function<bool(const double*, double)> family;
  if (continuum) family = strobed_family(system, *continuum);
  return {[system, cycles, family](const double* state, double psi) {
    for (const auto& trap : cycles)
      if (value(system, *trap, state, psi) < trap->level) return trap->attractor;
    return family && family(state, psi) ? balanced_id : 0;
  }};
}

}  // namespace

void set_traps(DecisionRule& rule, const model::System& system, const CycleTraps& cycles,
               const std::optional<ContinuumTrap>& continuum) {
  rule.cycles.clear();
  rule.family = {};
  rule.strobed = {};
  if (!system.autonomous()) {
    rule.strobed = strobed_traps(system, cycles, continuum);
    return;
  }
  for (const auto& trap : cycles) rule.cycles.push_back(table_of(*trap, system.balls()));
  if (continuum) rule.family = family_of(*continuum, system.dimension());
}

}  // namespace equipoise
