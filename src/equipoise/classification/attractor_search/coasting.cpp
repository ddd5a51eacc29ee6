// Coasting rotors: energy and short flights replace a search.
#include "equipoise/classification/attractor_search/search.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "equipoise/classification/trapping_regions/coasting_region.hpp"

namespace equipoise {

namespace {

// Both are measured: each start ends in a motion of its own.
int list_ends(const model::System& system, Catalogue& catalogue) {
  Motion balanced = measured_motion();
  balanced.set_valued = system.events().stick;
  catalogue.add({balanced_id, balanced.set_valued ? "balanced, stuck" : "balanced", "", balanced, {}});
  return catalogue.add({"stalled", "", 0}, measured_motion());
}

}  // namespace

AttractorSearch discover_coasting(const Study& study, const StopFlag* stop) {
  const model::System system = study.system();
  AttractorSearch result;
  result.balanced = analyse_balanced(system, stop);
  std::string& note = result.balanced.note;
  if (note.empty()) note = "no torque acts in the end, and the speed that the rotor then keeps is not known beforehand";
  ClassificationRule& rule = result.rule = first_rule(study, result.balanced, system);
  const double horizon = *study.numerics.horizon;
  // Windows must be long enough to show slow losses of speed.
  rule.first_long_window = std::max(rule.first_long_window, horizon / 16.0);
  rule.at_horizon = study.numerics.decide == ClassificationMode::horizon;
  const auto region = std::make_shared<const CoastingRegion>(system, study.stall_speed(), horizon);
  result.coasting = region;
  const int stalled = list_ends(system, result.catalogue);
  rule.section.regions = regions_by([region, stalled, stop](const double* state, double, const OwnRotor*) {
    return region->stalls(state) ? Caught{stalled} : region->balances(state, stop);
  });
  return result;
}

}  // namespace equipoise
