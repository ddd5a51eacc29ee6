// Runs an ensemble and keeps only its outcomes.
#include "equipoise/analyses/one_study/comparison.hpp"

namespace equipoise {

BasinOutcomes basin_outcomes(const Study& study, const RunOptions& options, std::optional<bool> transients) {
  BasinOutcomes outcomes;
  BasinOptions run;
  static_cast<RunOptions&>(run) = options;
  run.transients = transients;
  run.without_balls = false;
  run.keep_starts = true;
  BasinResult result = basin(study, run);
  outcomes.outcome = std::move(result.every_start->outcome);
  outcomes.transients = std::move(result.every_start->transients);
  outcomes.mean_speed = std::move(result.every_start->mean_speed);
  outcomes.study = result.study;
  outcomes.partial = result.partial;
  for (const OutcomeShare& a : result.attractors) outcomes.names[static_cast<short>(a.id)] = {a.name, a.alias};
  for (const OutcomeShare& o : result.others()) outcomes.names[static_cast<short>(o.id)] = {o.name, ""};
  return outcomes;
}

}  // namespace equipoise
