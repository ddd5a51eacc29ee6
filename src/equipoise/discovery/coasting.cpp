// Rotors that coast: energy and short flights in place of a search.
#include "equipoise/discovery/search.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "equipoise/traps/coasting_trap.hpp"

namespace equipoise {

namespace {

class EndsOfCoasting final : public TrapSet {
 public:
  EndsOfCoasting(std::shared_ptr<const CoastingTrap> trap, int stalled, const StopFlag* stop)
      : trap_(std::move(trap)), stalled_(stalled), stop_(stop) {}

  Caught ask(const double* state, double /*psi*/, const OwnRotor* /*own*/) const override {
    if (trap_->stalls(state)) return {stalled_};
    const CoastingTrap::Answer answer = trap_->balances(state, stop_);
    return {answer.balanced ? balanced_id : 0, answer.wait};
  }

 private:
  std::shared_ptr<const CoastingTrap> trap_;
  int stalled_;
  const StopFlag* stop_;
};

// Each start's motion is its own.
int list_ends(const model::System& system, Catalogue& catalogue) {
  Motion balanced = measured_motion();
  balanced.set_valued = system.events().stick;
  catalogue.add({balanced_id, balanced.set_valued ? "balanced, stuck" : "balanced", "", balanced, {}});
  return catalogue.add({"stalled", "", 0}, measured_motion());
}

}  // namespace

Discovery discover_coasting(const Study& study, const StopFlag* stop) {
  const model::System system = study.system();
  Discovery result;
  result.balanced = analyse_balanced(system, stop);
  std::string& note = result.balanced.note;
  if (note.empty()) note = "no torque acts in the end, and which speed the rotor keeps is not known beforehand";
  DecisionRule& rule = result.rule = first_rule(study, result.balanced, system);
  const double horizon = *study.numerics.horizon;
  // Slow losses of speed are to show.
  rule.first_long_window = std::max(rule.first_long_window, horizon / 16.0);
  rule.at_horizon = study.numerics.decide == DecideMode::horizon;
  const auto trap = std::make_shared<const CoastingTrap>(system, study.stall_speed(), horizon);
  result.coasting = trap;
  const int stalled = list_ends(system, result.catalogue);
  const Traps ends = std::make_shared<const EndsOfCoasting>(trap, stalled, stop);
  if (rule.at_horizon) {
    rule.strobed = ends;
  } else {
    rule.windowed.traps = ends;
    rule.windowed.r2_low = -1.0;
  }
  return result;
}

}  // namespace equipoise
