// Readings of table 7's protocol as segments of the rotor's motion, and tests of balance at a finite time.
#include "equipoise/reproduction/table_7.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "equipoise/base/error.hpp"
#include "equipoise/literature/paper_rotor.hpp"

namespace equipoise {

namespace {

struct Branch {
  double begin, end, speed, slope;  // of the ramp function
  BranchLaw law;

  // psi' and psi'' at `t`.
  double rate(double t) const {
    const double omega = speed + slope * (t - begin);
    if (law == BranchLaw::published) return omega + t * slope;
    if (law == BranchLaw::own_time) return omega + (t - begin) * slope;
    return omega;
  }
  double acceleration() const { return law == BranchLaw::kinematic ? slope : 2.0 * slope; }
};

}  // namespace

std::array<double, 3> Table7Protocol::ends(const Table7Row& row) const {
  if (durations) return {row.t0, row.t0 + row.t1, row.t0 + row.t1 + row.t2};
  return {row.t0, row.t1, row.t2};
}

double Table7Protocol::release_time(const Table7Row& row) const {
  const auto [t0, t1, t2] = ends(row);
  switch (release) {
    case Table7Release::at_hold_end:
      return t1;
    case Table7Release::at_fall_speed:
      return t1 + (t2 - t1) * (peak - release_speed) / (peak - final);
    case Table7Release::at_settling:
      return t2;
    case Table7Release::at_rise_speed:
      break;
  }
  return release_speed == peak ? t0 : t0 * release_speed / peak;
}

std::vector<model::Segment> Table7Protocol::segments(const Table7Row& row) const {
  const auto [t0, t1, t2] = ends(row);
  constexpr double never = std::numeric_limits<double>::infinity();
  const Branch branches[] = {{0.0, t0, 0.0, peak / t0, rise},
                             {t0, t1, peak, 0.0, BranchLaw::kinematic},
                             {t1, t2, peak, (final - peak) / (t2 - t1), fall},
                             {t2, never, final, 0.0, BranchLaw::kinematic}};
  const double free_from = release_time(row);
  std::vector<model::Segment> result;
  double psi = 0.0;
  const auto add = [&](const Branch& b, double begin, double end) {
    if (!(begin < end)) return;
    result.push_back({begin, end, psi, b.rate(begin), b.acceleration(), end <= free_from});
    if (end < never) psi = result.back().psi_at(end);
  };
  for (const Branch& b : branches) {
    const double cut = std::clamp(free_from, b.begin, b.end);
    add(b, b.begin, cut);
    add(b, cut, b.end);
  }
  return result;
}

Study Table7Protocol::study(const Table7Row& row) const {
  const auto [t0, t1, t2] = ends(row);
  Study study = paper_rotor(damping, drag);
  study.name = "table 7";
  study.parameters.eccentricity = eccentricity;
  study.parameters.mass = {mass, mass};
  study.speed.profile = Profile::trapezoid;
  study.speed.peak = peak;
  study.speed.final = final;
  study.speed.rise_until = t0;
  study.speed.hold_until = t1;
  study.speed.fall_until = t2;
  return study;
}

std::uint64_t called_balanced(const Observation& observation, const Table7Test& test) {
  const auto first = static_cast<std::size_t>(std::lround(test.from / observation.window));
  const auto end = static_cast<std::size_t>(std::lround(test.to / observation.window));
  const auto limit = static_cast<float>(test.tolerance * test.tolerance);
  const auto passes = [&](float r2) { return r2 < limit; };  // not-a-number does not
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < observation.starts; ++i) {
    const std::size_t row = i * observation.windows;
    const float* largest = &observation.largest[row];
    count +=
        first == end ? passes(observation.at_end[row + end - 1]) : std::all_of(largest + first, largest + end, passes);
  }
  return count;
}

Table7Reading table_7_lead() {
  Table7Reading lead;
  lead.protocol.rise = lead.protocol.fall = BranchLaw::kinematic;
  lead.protocol.release_speed = 2.2;
  lead.test = {630.0, 730.0, 1.34e-3};
  return lead;
}

std::vector<ObservationReading> observe_table_7(const Table7Reading& reading, std::uint64_t starts, int threads,
                                                const StopFlag* stop) {
  constexpr std::uint64_t batch = 32768;  // 20 MB of r^2 at 73 windows
  ObservationSettings settings;
  settings.window = table_7_window;
  settings.until = reading.test.to;
  settings.threads = threads;
  settings.stop = stop;
  std::vector<ObservationReading> readings;
  for (const Table7Row& row : table_7_rows) {
    std::uint64_t count = 0;
    for (std::uint64_t first = 0; first < starts; first += batch) {
      settings.first = first;
      settings.starts = std::min(batch, starts - first);
      const Observation seen = observe(reading.protocol.study(row), reading.protocol.segments(row), settings);
      if (!seen.complete) throw RunError("stopped before table 7 was observed");
      count += called_balanced(seen, reading.test);
    }
    readings.push_back({row, wilson_share(count, starts)});
  }
  return readings;
}

}  // namespace equipoise
