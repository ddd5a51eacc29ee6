// Coasting rotors: energy and short flights replace a search.
#include "equipoise/classification/attractor_search/search.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "equipoise/attractors/words/motions.hpp"
#include "equipoise/classification/trapping_regions/coasting_region.hpp"
#include "equipoise/simulation/words/runs.hpp"

namespace equipoise {

namespace {

class EndsOfCoasting final : public TrappingRegions {
 public:
  EndsOfCoasting(std::shared_ptr<const CoastingRegion> region, int stalled, const StopFlag* stop)
      : region_(std::move(region)), stalled_(stalled), stop_(stop) {}

  Caught ask(const double* state, double /*psi*/, const OwnRotor* /*own*/) const override {
    if (region_->stalls(state)) return {stalled_};
    const CoastingRegion::Answer answer = region_->balances(state, stop_);
    return {answer.balanced ? balanced_id : 0, answer.wait};
  }

 private:
  std::shared_ptr<const CoastingRegion> region_;
  int stalled_;
  const StopFlag* stop_;
};

// Both are measured: each start comes to a motion of its own.
int list_ends(const model::System& system, Catalogue& catalogue) {
  Motion balanced = measured_motion();
  balanced.set_valued = system.events().stick;
  catalogue.add(
      {balanced_id, balanced.set_valued ? words::motions::balanced_stuck : words::motions::balanced, "", balanced, {}});
  return catalogue.add({"stalled", "", 0}, measured_motion());
}

}  // namespace

AttractorSearch discover_coasting(const Study& study, const StopFlag* stop) {
  const model::System system = study.system();
  AttractorSearch result;
  result.balanced = analyse_balanced(system, stop);
  std::string& note = result.balanced.note;
  if (note.empty()) note = words::runs::unknown_end;
  ClassificationRule& rule = result.rule = first_rule(study, result.balanced, system);
  const double horizon = *study.numerics.horizon;
  // Windows must be long enough to show slow losses of speed.
  rule.first_long_window = std::max(rule.first_long_window, horizon / 16.0);
  rule.at_horizon = study.numerics.decide == ClassificationMode::horizon;
  const auto region = std::make_shared<const CoastingRegion>(system, study.stall_speed(), horizon);
  result.coasting = region;
  const int stalled = list_ends(system, result.catalogue);
  const SharedRegions ends = std::make_shared<const EndsOfCoasting>(region, stalled, stop);
  if (rule.at_horizon) {
    rule.section_regions = ends;
  } else {
    rule.windowed.regions = ends;
    rule.windowed.r2_low = -1.0;
  }
  return result;
}

}  // namespace equipoise
