// An ensemble of which nothing but outcomes is kept.
#include "equipoise/basins/comparison.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

BasinOutcomes basin_outcomes(const Study& study, const RunOptions& options) {
  BasinOutcomes outcomes;
  BasinOptions run;
  static_cast<RunOptions&>(run) = options;
  run.transients = false;
  run.fate = [&](const Fate& fate) { outcomes.outcome.push_back(code_of(fate)); };
  const BasinResult result = basin(study, run);
  outcomes.study = result.study;
  outcomes.partial = result.partial;
  for (const AttractorShare& a : result.attractors) outcomes.names[static_cast<short>(a.id)] = {a.name, a.alias};
  const auto add = [&](short code, Outcome outcome) { outcomes.names[code] = {name_of(outcome), ""}; };
  add(undecided_code, Outcome::undecided);
  add(diverged_code, Outcome::diverged);
  add(failed_code, Outcome::failed);
  if (result.stalled) add(stalled_code, Outcome::stalled);
  return outcomes;
}

}  // namespace equipoise
