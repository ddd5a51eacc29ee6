// The lead on table 7: the studies of its rows with another release, and a test of balance at a finite time.
#include "equipoise/extras/reproduction/reproduction.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/literature/published_tables.hpp"

namespace equipoise {

std::string Table7Row::label() const { return fmt::format("{}, {}, {}", t0, t1, t2); }

std::uint64_t called_balanced(const Observation& observation, const Table7Test& test) {
  const auto first = static_cast<std::size_t>(std::lround(test.from / observation.window));
  const auto end = static_cast<std::size_t>(std::lround(test.to / observation.window));
  const auto limit = static_cast<float>(test.tolerance * test.tolerance);
  const auto passes = [&](float r2) { return r2 < limit; };  // NaN does not pass
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < observation.starts; ++i) {
    const std::size_t row = i * observation.windows;
    const float* largest = &observation.largest[row];
    count +=
        first == end ? passes(observation.at_end[row + end - 1]) : std::all_of(largest + first, largest + end, passes);
  }
  return count;
}

std::vector<LeadReading> observe_table_7_lead(std::uint64_t starts, int threads, const StopFlag* stop) {
  constexpr std::uint64_t batch = 32768;  // 20 MB of r^2 at 73 windows
  constexpr Table7Test test{630.0, 730.0, 1.34e-3};
  ObservationSettings settings;
  settings.window = table_7_window;
  settings.until = test.to;
  settings.threads = threads;
  settings.stop = stop;
  std::vector<LeadReading> readings;
  for (std::size_t k = 0; k < table_7_rows.size(); ++k) {
    Study study = study_of(published_tables().back().rows[k], model::SpeedLaw::kinematic);
    study.release.speed = 2.2;
    std::uint64_t count = 0;
    for (std::uint64_t first = 0; first < starts; first += batch) {
      settings.first = first;
      settings.starts = std::min(batch, starts - first);
      const Observation seen = observe(study, settings);
      if (!seen.complete) throw RunError("stopped before table 7 was observed");
      count += called_balanced(seen, test);
    }
    readings.push_back({table_7_rows[k], wilson_share(count, starts)});
  }
  return readings;
}

}  // namespace equipoise
