// Tables for lanes, and functions for single states.
#include "equipoise/traps/trap_rule.hpp"

#include <algorithm>
#include <limits>
#include <array>
#include <cmath>
#include <complex>
#include <utility>

#include "equipoise/lanes/own_rotor.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/unbalance.hpp"
#include "equipoise/motions/event_motion.hpp"
#include "equipoise/motions/stuck.hpp"
#include "equipoise/orbits/stroboscopic.hpp"
#include "equipoise/traps/balanced_family.hpp"

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

class Continuum final : public TrapSet {
 public:
  Continuum(const model::System& system, const ContinuumTrap& trap) : trap_(trap), size_(system.dimension()) {}

  Caught ask(const double* state, double /*psi*/, const OwnRotor* own) const override {
    return {trap_.holds(Eigen::Map<const Eigen::VectorXd>(state, size_), own) ? balanced_id : 0};
  }

 private:
  ContinuumTrap trap_;
  int size_;
};

// Of states against levels that are known to per cents, of deviations of 1e-3 and more.
constexpr double near_enough = 1e-8;

// To tell what a state near a continuum comes to is dear, and a state that was refused once may linger there for long:
// it is asked again when the rotor has turned by as much more of all that it has turned. `half`: by so much it turns
// in half a window, where it may be asked.
bool is_due(double psi, double half) {
  constexpr double later = 0.2;
  const double before = std::fabs(psi) - half;
  if (before <= half) return true;
  const auto times = [](double turned) { return std::floor(std::log(turned) / std::log1p(later)); };
  return times(std::fabs(psi)) != times(before);
}

// With what gravity leaves of a continuum the same is asked of the state at the next strobe.
class StrobedContinuum {
 public:
  StrobedContinuum(const model::System& system, const ContinuumTrap& trap, double window)
      : system_(system),
        passing_(without_events(system)),
        trap_(trap),
        rest_(unbalance_of_rest(system)),
        half_(0.5 * window * std::fabs(system.speed())) {}

  bool holds(const double* at, double psi, const OwnRotor* own) const {
    const model::Parameters& p = (own ? own->system : system_).parameters();
    const std::complex<double> rest = own ? unbalance_of_rest(own->system) : rest_;
    if (!balls_in_reach(p, trap_, rest, at) || !is_due(psi, half_)) return false;
    // So near to balance it makes no difference whether balls touch before that.
    const auto state = at_next_strobe(own ? without_events(own->system) : passing_,
                                      Eigen::Map<const Eigen::VectorXd>(at, passing_.dimension()), psi, near_enough);
    return state && balls_in_reach(p, trap_, rest, state->data()) && rotor_in_reach(trap_, *state) &&
           trap_.holds(*state, own);
  }

 private:
  model::System system_, passing_;
  ContinuumTrap trap_;
  std::complex<double> rest_;
  double half_;  // by so much the rotor turns in half a window
};

// An own rotor's well is its own, and is as deep for every order of its balls.
int stalled_in(const model::System& system, const StalledTrap& stalled, const double* state, const OwnRotor* own) {
  if (!own) return stalled.caught(system, state);
  const auto well = model::GravityWell::of(own->system);
  return well ? StalledTrap{*well, stalled.rests}.caught(own->system, state) : 0;
}

// Of a rotor of its own: the trap of a balanced motion stands beside where it was made, as the balanced state does.
double value_for(const model::System& system, const CycleTrap& trap, const double* state, double psi,
                 const OwnRotor* own) {
  if (!own || trap.attractor != balanced_id) return value(system, trap, state, psi);
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::VectorXd& shift : balanced_shifts(own->system, system)) {
    const Eigen::VectorXd moved = Eigen::Map<const Eigen::VectorXd>(state, system.dimension()) - shift;
    least = std::min(least, value(system, trap, moved.data(), psi));
  }
  return least;
}

class Strobed final : public TrapSet {
 public:
  Strobed(const model::System& system, const CycleTraps& cycles, const std::optional<ContinuumTrap>& continuum,
          const std::optional<StalledTrap>& stalled, double window)
      : system_(system), cycles_(cycles), stalled_(stalled) {
    if (continuum) continuum_.emplace(system, *continuum, window);
  }

  Caught ask(const double* state, double psi, const OwnRotor* own) const override {
    if (const int attractor = stalled_ ? stalled_in(system_, *stalled_, state, own) : 0) return {attractor};
    for (const auto& trap : cycles_)
      if (value_for(system_, *trap, state, psi, own) < trap->level) return {trap->attractor};
    return {continuum_ && continuum_->holds(state, psi, own) ? balanced_id : 0};
  }

 private:
  model::System system_;
  CycleTraps cycles_;
  std::optional<StalledTrap> stalled_;
  std::optional<StrobedContinuum> continuum_;
};

class StuckBalls final : public TrapSet {
 public:
  StuckBalls(const model::System& system, const Catalogue& listed) : system_(system), listed_(listed) {}

  Caught ask(const double* state, double psi, const OwnRotor* own) const override {
    const model::System& rotor = own ? own->system : system_;
    const Eigen::Map<const Eigen::VectorXd> y(state, system_.dimension());
    const auto end = stuck_for_good(rotor, y, psi);
    return {end ? listed_.find(rotor.parameters(), describe_stuck(rotor, *end)) : 0};
  }

 private:
  model::System system_;
  Catalogue listed_;
};

}  // namespace

void set_traps(DecisionRule& rule, const model::System& system, const CycleTraps& cycles,
               const std::optional<ContinuumTrap>& continuum, const std::optional<StalledTrap>& stalled) {
  rule.cycles.clear();
  rule.family = {};
  rule.strobed = nullptr;
  if (!system.autonomous()) {
    if (!cycles.empty() || continuum || stalled)
      rule.strobed = std::make_shared<const Strobed>(system, cycles, continuum, stalled, rule.window);
    return;
  }
  for (const auto& trap : cycles) rule.cycles.push_back(table_of(*trap, system.balls()));
  if (!continuum) return;
  // Lanes measure the way to a continuum from where the rotor is centred.
  if (system.parameters().race_is_centred())
    rule.family = {continuum->reach, std::make_shared<const Continuum>(system, *continuum)};
  else
    rule.strobed = std::make_shared<const Strobed>(system, CycleTraps{}, continuum, std::nullopt, rule.window);
}

Traps stuck_balls(const model::System& system, const Catalogue& listed) {
  return std::make_shared<const StuckBalls>(system, listed);
}

}  // namespace equipoise
