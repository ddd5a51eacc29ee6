// Runs an ensemble and keeps only its outcomes.
#include "equipoise/analyses/comparison.hpp"

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
  for (const OutcomeShare& a : result.attractors) outcomes.names[static_cast<short>(a.id)] = {a.name, a.alias};
  for (const OutcomeShare& o : result.others()) outcomes.names[static_cast<short>(o.id)] = {o.name, ""};
  return outcomes;
}

}  // namespace equipoise
