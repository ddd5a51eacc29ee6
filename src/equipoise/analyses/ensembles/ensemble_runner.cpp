// What an ensemble's options ask of its study and its search.
#include "equipoise/analyses/ensembles/ensemble_runner.hpp"

#include <utility>

#include <fmt/format.h>

#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/parallel.hpp"

namespace equipoise {

Study as_sampled(Study study) {
  study.sampling.method = study.sampling.method.value_or(SamplingMethod::random);
  return with_horizon(std::move(study));
}

bool gathers_transients(const Study& study, const BasinOptions& options) {
  return options.transients.value_or(study.limits.any() || study.standards.any());
}

void take_given_starts(const BasinOptions& options, Study& study) {
  check_takes_starts(study);
  if (options.half_width > 0.0)
    throw InputError("starts of your own", "half_width", fmt::format("{}", options.half_width),
                     "all of them are followed; must be 0");
  const SamplingMethod method = study.sampling.method.value_or(SamplingMethod::random);
  if (method != SamplingMethod::random)
    throw InputError(study.name, "sampling.method", sampling_method_names[static_cast<std::size_t>(method)],
                     "says how starts are drawn, which are given here; must be left out, or \"random\"");
  check_given_starts(study, options.initial);
  study.sampling.method = method;
  study.sampling.starts = options.initial.size();
  study.sampling.box = {};
}

AttractorSearchSettings search_settings(const BasinOptions& options, AttractorSearchCache* searches) {
  return {.threads = options.search_threads > 0 ? options.search_threads : thread_count(options.threads),
          .stop = options.stop,
          .warm_start_states = options.warm_start_states,
          .cache = searches,
          .progress = options.progress,
          .mode = options.search,
          .starts = options.search_serves,
          .warm_start_levels = options.warm_start_levels ? *options.warm_start_levels : WarmStartLevels{},
          .notes = options.notes};
}

}  // namespace equipoise
