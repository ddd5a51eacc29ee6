// Records displacements of an ensemble in windows: chunks of starts are followed segment by segment.
#include "equipoise/analyses/one_study/observation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/results/columns/transient_figures.hpp"
#include "equipoise/simulation/batch/batch_task.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"
#include "equipoise/simulation/spin_up/start_source.hpp"
#include "equipoise/study/sampling/starts.hpp"

namespace equipoise {

namespace {

void check_settings(const Study& study, const ObservationSettings& s) {
  const auto reject = [&](const char* key, double value, const char* problem) {
    throw InputError(study.name, key, fmt::format("{}", value), problem);
  };
  if (s.starts == 0) reject("observation starts", 0.0, "must be 1 or more");
  if (!(s.window > 0.0) || !std::isfinite(s.window)) reject("observation window", s.window, "must be finite, above 0");
  if (!(s.until >= s.window) || !std::isfinite(s.until))
    reject("observation end", s.until, "must be finite and leave room for one window");
}

// Follows starts at places place .. place + count - 1 of the tables. False if stopped early.
bool follow(const Study& study, const StartSource& source, std::uint64_t first, std::size_t place, std::size_t count,
            Observation& result) {
  std::vector<InitialState> starts(count, study.initial);
  for (std::size_t i = 0; i < count; ++i)
    start_angles(study.sampling.seed, first + place + i, study.parameters.balls, starts[i].phi.data());
  std::vector<double> states;
  source.release(starts, states);
  const std::size_t at = place * result.windows;
  const RadiusWindows record{result.window,
                             result.windows,
                             &result.largest[at],
                             &result.at_end[at],
                             study.system().layout().tilt,
                             watched_shaft(study).places};
  const double until = result.end_of(result.windows - 1);
  std::vector<Outcome> outcomes(count);
  for (std::size_t k = source.first_free(); k < source.segments().size(); ++k) {
    BatchTask task = source.task(k, states);
    task.end = std::min(task.end, until);
    task.radius = &record;
    if (!(task.segment.begin < task.end)) break;
    if (!advance_batch(task, outcomes)) return false;
    if (task.end < task.segment.end) break;
    source.cross(k, states);
  }
  return true;
}

// Fills the tables before any window: not-a-number before the release, 0 from it on.
void blank(const StartSource& source, Observation& result) {
  const double release = source.segments()[source.first_free()].begin;
  std::vector<float> row(result.windows, 0.0f);
  for (std::size_t k = 0; k < result.windows && result.end_of(k) <= release; ++k)
    row[k] = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < result.starts; ++i) result.largest.insert(result.largest.end(), row.begin(), row.end());
  result.at_end = result.largest;
}

Observation observe_from(const Study& study, const StartSource& source, const ObservationSettings& settings) {
  Observation result;
  result.starts = settings.starts;
  result.window = settings.window;
  result.windows = static_cast<std::size_t>(std::floor(settings.until / settings.window * (1.0 + 1e-12)));
  blank(source, result);
  const auto decide = [&](Chunk& c) { return follow(study, source, settings.first, c.first, c.count, result); };
  result.complete = take_chunks({.decide = decide, .threads = thread_count(settings.threads), .stop = settings.stop}, 0,
                                result.starts, [&](Chunk& c) {
                                  if (settings.progress)
                                    settings.progress({c.first + c.count, result.starts, "starts", {}});
                                  return true;
                                });
  return result;
}

template <class SourceWith>
Observation observed(const Study& study, const ObservationSettings& settings, const SourceWith& source) {
  check_offers(study, model::ResultKind::displacements);
  check_settings(study, settings);
  return long_call(settings, [&](const ObservationSettings& s) { return observe_from(study, source(s.stop), s); });
}

}  // namespace

Observation observe(const Study& study, const ObservationSettings& settings) {
  return observed(study, settings, [&](const StopFlag* stop) { return StartSource(study, stop); });
}

Observation observe(const Study& study, const std::vector<model::Segment>& segments,
                    const ObservationSettings& settings) {
  return observed(study, settings, [&](const StopFlag* stop) { return StartSource(study, segments, stop); });
}

}  // namespace equipoise
