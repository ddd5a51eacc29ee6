// Tables for lanes, and functions for single states.
#include "equipoise/traps/trap_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <utility>

#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/unbalance.hpp"
#include "equipoise/motions/event_motion.hpp"
#include "equipoise/orbits/stroboscopic.hpp"

namespace equipoise {

namespace {

// The unbalance of what the continuum holds: 0 but for a race off its centre.
std::complex<double> unbalance_of_rest(const model::System& system) {
  const model::Parameters& p = system.parameters();
  const model::CentredTwin twin = model::centred_twin(p, model::balanced_speed(system).value_or(0.0));
  return p.eccentricity - std::polar(twin.parameters.eccentricity, twin.turn);
}

// Velocities of the balls and imbalance are within the reach of what the continuum holds.
bool balls_in_reach(const model::Parameters& p, const ContinuumTrap& trap, std::complex<double> rest,
                    const double* state) {
  double away = std::abs(model::unbalance(p, state + model::index::phi(0)) - rest);
  for (int i = 0; i < p.balls; ++i) away = std::max(away, std::fabs(state[model::index::q(i, p.balls)]));
  return away < trap.reach;
}

bool rotor_in_reach(const ContinuumTrap& trap, const Eigen::VectorXd& state) {
  return (state.head(4) - trap.place).lpNorm<Eigen::Infinity>() < trap.reach;
}

FamilyTrap family_of(const model::System& system, const ContinuumTrap& trap) {
  return {trap.reach, [trap, size = system.dimension()](const double* at) {
            return trap.holds(Eigen::Map<const Eigen::VectorXd>(at, size));
          }};
}

// Of states against levels that are known to per cents, of deviations of 1e-3 and more.
constexpr double near_enough = 1e-8;

// With what gravity leaves of a continuum the same is asked of the state at the next strobe.
std::function<bool(const double*, double)> strobed_family(const model::System& system, const ContinuumTrap& trap) {
  // So near to balance it makes no difference whether balls touch before that.
  return [p = system.parameters(), passing = without_events(system), trap, rest = unbalance_of_rest(system)](
             const double* at, double psi) {
    if (!balls_in_reach(p, trap, rest, at)) return false;
    const auto state =
        at_next_strobe(passing, Eigen::Map<const Eigen::VectorXd>(at, passing.dimension()), psi, near_enough);
    return state && balls_in_reach(p, trap, rest, state->data()) && rotor_in_reach(trap, *state) && trap.holds(*state);
  };
}

StrobedTraps strobed_traps(const model::System& system, const CycleTraps& cycles,
                           const std::optional<ContinuumTrap>& continuum, const std::optional<StalledTrap>& stalled) {
  if (cycles.empty() && !continuum && !stalled) return {};
  std::function<bool(const double*, double)> family;
  if (continuum) family = strobed_family(system, *continuum);
  return {[system, cycles, family, stalled](const double* state, double psi) {
    if (const int attractor = stalled ? stalled->caught(system, state) : 0) return attractor;
    for (const auto& trap : cycles)
      if (value(system, *trap, state, psi) < trap->level) return trap->attractor;
    return family && family(state, psi) ? balanced_id : 0;
  }};
}

}  // namespace

void set_traps(DecisionRule& rule, const model::System& system, const CycleTraps& cycles,
               const std::optional<ContinuumTrap>& continuum, const std::optional<StalledTrap>& stalled) {
  rule.cycles.clear();
  rule.family = {};
  rule.strobed = {};
  if (!system.autonomous()) {
    rule.strobed = strobed_traps(system, cycles, continuum, stalled);
    return;
  }
  for (const auto& trap : cycles) rule.cycles.push_back(table_of(*trap, system.balls()));
  if (!continuum) return;
  // Lanes measure the way to a continuum from where the rotor is centred.
  if (system.parameters().race_is_centred())
    rule.family = family_of(system, *continuum);
  else
    rule.strobed = strobed_traps(system, {}, continuum, {});
}

}  // namespace equipoise
