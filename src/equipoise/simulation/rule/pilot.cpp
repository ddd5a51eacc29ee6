// Groups of like motions, boxes around them, and how many windows in a box decide.
#include "equipoise/simulation/rule/pilot.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/simulation/rule/window_features.hpp"

namespace equipoise {

namespace {

// Least margin of a box, relative to the largest r or rate. A trajectory this close to a stable motion in every feature
// for several windows does not leave it again (no exception among 300 000 starts followed to t = 3000).
constexpr double box_floor = 0.02;
constexpr int fewest_hits = 3;
// Beyond this many half windows, long windows decide as soon.
constexpr int most_hits = 80;
// If a box would have decided this many trajectories, all correctly, its share of errors is below 3 % (95 %
// confidence). Requiring twice the longest wrong run of as large a sample leaves far fewer. At most 2.4 % of a pilot's
// starts end in a rarer motion, so following these for longer costs little.
constexpr int least_evidence = 100;

bool admits_balance(const FeatureBox& box, int balls) {
  for (int k = 0; k < speed_feature(balls); ++k)  // a rotor may be balanced at any speed
    if (box.low[k] > 0.0 || box.high[k] < 0.0) return false;
  return true;
}

}  // namespace

std::vector<MotionGroup> group_records(const std::vector<PilotRecord>& records, const std::vector<std::size_t>& which,
                                       int balls, double tolerance) {
  std::vector<MotionGroup> groups;
  for (std::size_t i : which) {
    const PilotRecord& record = records[i];
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const MotionGroup& group) {
      return same_motion(group.features, record.features, balls, tolerance);
    });
    if (same == groups.end()) {
      groups.push_back({{i}, record.features, record.range});
      continue;
    }
    same->members.push_back(i);
    for (int k = 0; k < feature_count(balls); ++k) {
      same->range.low[k] = std::min(same->range.low[k], record.range.low[k]);
      same->range.high[k] = std::max(same->range.high[k], record.range.high[k]);
    }
  }
  return groups;
}

FeatureBox box_around(const FeatureBox& range, int balls, int attractor, double widths) {
  FeatureBox box;
  const int speed = speed_feature(balls), count = feature_count(balls);
  const auto largest = [&](int from, int to) {
    double size = 0.0;
    for (int k = from; k < to; ++k) size = std::max({size, std::fabs(range.low[k]), std::fabs(range.high[k])});
    return size;
  };
  const double rate = largest(3, speed), turning = largest(speed, count);
  for (int k = 0; k < count; ++k) {
    const double size = k < 3 ? range.high[1] : k < speed ? rate : turning;
    const double margin = widths * (range.high[k] - range.low[k]) + box_floor * size;
    box.low[k] = range.low[k] - margin;
    box.high[k] = range.high[k] + margin;
  }
  box.attractor = admits_balance(box, balls) ? 0 : attractor;
  return box;
}

int hits_from_audit(const std::vector<Outcome>& outcomes, const std::vector<PilotRecord>& records, std::size_t b,
                    int attractor, bool undecided_is_own) {
  const auto own = [&](std::size_t i) {
    return outcomes[i].attractor == attractor || (outcomes[i].attractor == 0 && undecided_is_own);
  };
  int longest = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    if (!own(i)) longest = std::max(longest, records[i].longest_run[b]);
  const int hits = std::max(fewest_hits, 2 * longest + 1);
  if (hits > most_hits) return 0;
  int rightly = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) rightly += own(i) && records[i].longest_run[b] >= hits;
  return rightly >= least_evidence ? hits : 0;
}

}  // namespace equipoise
