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
#include "equipoise/orbits/return_map.hpp"
#include "equipoise/orbits/stroboscopic.hpp"

namespace equipoise {

namespace {

// Where x, y, u, v and the unbalance are of what the continuum holds: at 0 but for a race off its centre.
struct Rest {
  Eigen::Vector4d place;
  std::complex<double> unbalance;
};

Rest rest_of(const model::System& system) {
  const model::Parameters& p = system.parameters();
  const double speed = model::balanced_speed(system).value_or(0.0);
  const std::array<double, model::max_balls> anywhere{};
  const model::CentredTwin twin = model::centred_twin(p, speed);
  return {model::balanced_state(system, speed, anywhere.data()).head(4),
          p.eccentricity - std::polar(twin.parameters.eccentricity, twin.turn)};
}

// Velocities, x, y and imbalance are all within the reach of what the continuum holds.
bool in_reach(const model::Parameters& p, const ContinuumTrap& trap, const Rest& rest, const double* state) {
  double away = std::abs(model::unbalance(p, state + model::index::phi(0)) - rest.unbalance);
  for (int i = 0; i < 4; ++i) away = std::max(away, std::fabs(state[i] - rest.place[i]));
  for (int i = 0; i < p.balls; ++i) away = std::max(away, std::fabs(state[model::index::q(i, p.balls)]));
  return away < trap.reach;
}

// Of two balls each may come as far from its place as the trap reaches, and this state is as far from where they end.
bool keeps_apart(const model::Parameters& p, const ContinuumTrap& trap, const Eigen::VectorXd& state) {
  return !p.balls_collide() || least_gap(p, state) > 4.0 * trap.reach;
}

FamilyTrap family_of(const model::System& system, const ContinuumTrap& trap) {
  return {trap.reach, [trap, p = system.parameters(), size = system.dimension()](const double* at) {
            const Eigen::VectorXd state = Eigen::Map<const Eigen::VectorXd>(at, size);
            return keeps_apart(p, trap, state) && trap.holds(state);
          }};
}

// With what gravity leaves of a continuum the same is asked of the state at the next strobe.
std::function<bool(const double*, double)> strobed_family(const model::System& system, const ContinuumTrap& trap) {
  // So near to balance nothing touches before the next strobe that is not about to touch now.
  return [system, passing = without_events(system), trap, rest = rest_of(system)](const double* at, double psi) {
    const Eigen::VectorXd state = Eigen::Map<const Eigen::VectorXd>(at, system.dimension());
    if (!in_reach(system.parameters(), trap, rest, at) || !keeps_apart(system.parameters(), trap, state)) return false;
    const auto at_strobe = at_next_strobe(passing, state, psi);
    return at_strobe && keeps_apart(system.parameters(), trap, *at_strobe) && trap.holds(*at_strobe);
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
  if (!continuum) return;
  // Lanes measure the way to a continuum from where the rotor is centred.
  if (system.parameters().race_is_centred())
    rule.family = family_of(system, *continuum);
  else
    rule.strobed = strobed_traps(system, {}, continuum);
}

}  // namespace equipoise
