// Records displacements of an ensemble in windows: chunks of starts are followed segment by segment.
#include "equipoise/analyses/one_study/observation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>

#include <fmt/format.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/core/running/reporting.hpp"
#include "equipoise/results/columns/watched_shaft.hpp"
#include "equipoise/simulation/batch/batch_task.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/start_source.hpp"
#include "equipoise/study/sampling/starts.hpp"

namespace equipoise {

namespace {

// Large enough that lanes seldom wait for a chunk's last trajectory.
constexpr std::size_t chunk_size = 1024;

void check_settings(const Study& study, const ObservationSettings& s) {
  const auto reject = [&](const char* key, double value, const char* problem) {
    throw InputError(study.name, key, fmt::format("{}", value), problem);
  };
  if (s.starts == 0) reject("observation starts", 0.0, "must be 1 or more");
  if (!(s.window > 0.0) || !std::isfinite(s.window)) reject("observation window", s.window, "must be finite, above 0");
  if (!(s.until >= s.window) || !std::isfinite(s.until))
    reject("observation end", s.until, "must be finite and leave room for one window");
}

class Observer {
 public:
  Observer(const Study& study, const StartSource& source, const ObservationSettings& settings, Observation& result)
      : study_(study), source_(source), settings_(settings), result_(result) {}

  // Follows starts at places place .. place + count - 1. False if stopped early.
  bool run(std::size_t place, std::size_t count) const {
    const std::size_t n = static_cast<std::size_t>(study_.parameters.balls);
    std::vector<double> phi(count * n), states;
    for (std::size_t i = 0; i < count; ++i)
      start_angles(study_.sampling.seed, settings_.first + place + i, study_.parameters.balls, &phi[i * n]);
    source_.release(phi, states);
    const std::size_t at = place * result_.windows;
    const RadiusWindows record{result_.window,
                               result_.windows,
                               &result_.largest[at],
                               &result_.at_end[at],
                               study_.system().layout().tilt,
                               watched_shaft(study_).places};
    const double until = result_.end_of(result_.windows - 1);
    std::vector<Fate> fates(count);
    for (std::size_t k = source_.first_free(); k < source_.segments().size(); ++k) {
      BatchTask task = source_.task(k, states);
      task.end = std::min(task.end, until);
      task.radius = &record;
      if (!(task.segment.begin < task.end)) break;
      if (!advance_batch(task, fates)) return false;
      if (task.end < task.segment.end) break;
      source_.cross(k, states);
    }
    return true;
  }

 private:
  const Study& study_;
  const StartSource& source_;
  const ObservationSettings& settings_;
  Observation& result_;
};

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
  const Observer observer(study, source, settings, result);
  std::atomic<bool> lost{false};
  std::mutex reporting;
  std::uint64_t done = 0;
  const std::size_t chunks = (result.starts + chunk_size - 1) / chunk_size;
  in_parallel(thread_count(settings.threads), chunks, [&](std::size_t chunk) {
    const std::size_t place = chunk * chunk_size;
    const std::size_t count = std::min(chunk_size, result.starts - place);
    if (!lost && !observer.run(place, count)) lost = true;
    if (lost || !settings.progress) return;
    const std::lock_guard lock(reporting);
    settings.progress({done += count, result.starts, "starts", {}});
  });
  result.complete = !lost;
  return result;
}

}  // namespace

Observation observe(const Study& study, const ObservationSettings& settings) {
  check_offers(study, model::ResultKind::displacements);
  check_settings(study, settings);
  const ChosenCpuTarget chosen(settings.cpu_target);
  return reported(settings,
                  [&](const ObservationSettings& s) { return observe_from(study, StartSource(study, s.stop), s); });
}

Observation observe(const Study& study, const std::vector<model::Segment>& segments,
                    const ObservationSettings& settings) {
  check_offers(study, model::ResultKind::displacements);
  check_settings(study, settings);
  const ChosenCpuTarget chosen(settings.cpu_target);
  return reported(settings, [&](const ObservationSettings& s) {
    return observe_from(study, StartSource(study, segments, s.stop), s);
  });
}

}  // namespace equipoise
