// Runs ensembles and keeps only their outcomes; both sides of a comparison.
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
  static_cast<StartArrays&>(outcomes) = std::move(*result.every_start);
  outcomes.study = result.study;
  outcomes.partial = result.partial;
  for (const OutcomeShare& a : result.attractors) outcomes.names[static_cast<short>(a.id)] = {a.name, a.alias};
  for (const OutcomeShare& o : result.others()) outcomes.names[static_cast<short>(o.id)] = {o.name, ""};
  return outcomes;
}

ComparedSide::ComparedSide(const Study& given) : study(given) { check_comparable(given); }

ComparedSide::ComparedSide(const std::string& path) : stored(read_basin_outcomes(path)) {}

ComparisonResult compare(const ComparedSide& first, const ComparedSide& second, const RunOptions& of_first,
                         const RunOptions& of_second, std::optional<bool> transients) {
  const auto has_figures = [](const ComparedSide& s) {
    return s.study ? s.study->limits.any() : !s.stored->transients[0].empty();
  };
  const bool gather = transients.value_or(has_figures(first) || has_figures(second));
  const auto outcomes = [&](const ComparedSide& s, const RunOptions& options) {
    return s.study ? basin_outcomes(*s.study, options, gather) : *s.stored;
  };
  const BasinOutcomes one = outcomes(first, of_first);
  return compare(one, outcomes(second, of_second));
}

}  // namespace equipoise
