// Boxes around the stationary motions a pilot found.
#include "equipoise/attractors/pilot.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/attractors/window_features.hpp"

namespace equipoise {

namespace {

struct Group {
  Features features;
  FeatureBox range;
  int members = 1;
};

// Fewer members than this may be one odd transient; their starts are decided by stationarity alone.
constexpr int members_needed = 3;
// Two motions this close in every feature are recognised together: what matters here is that neither is balance.
constexpr double grouping = 0.05;
// Least margin of a box, relative to the largest r or rate: what is this close to a stable motion in every feature for
// several windows does not leave it again (no such case among 300 000 starts followed to t = 3000).
constexpr double box_floor = 0.02;

FeatureBox widened(const FeatureBox& range, int balls) {
  FeatureBox box;
  double rate = 0.0;
  for (int k = 3; k < feature_count(balls); ++k)
    rate = std::max({rate, std::fabs(range.low[k]), std::fabs(range.high[k])});
  for (int k = 0; k < feature_count(balls); ++k) {
    const double margin = (range.high[k] - range.low[k]) + box_floor * (k < 3 ? range.high[1] : rate);
    box.low[k] = range.low[k] - margin;
    box.high[k] = range.high[k] + margin;
  }
  return box;
}

bool admits_balance(const FeatureBox& box, int balls) {
  for (int k = 0; k < feature_count(balls); ++k)
    if (box.low[k] > 0.0 || box.high[k] < 0.0) return false;
  return true;
}

}  // namespace

std::vector<FeatureBox> boxes_from_pilot(const std::vector<PilotRecord>& records, const DecisionRule& rule) {
  std::vector<Group> groups;
  for (const PilotRecord& record : records) {
    if (!record.stationary) continue;
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return same_motion(group.features, record.features, rule.balls, grouping);
    });
    if (same == groups.end()) {
      groups.push_back({record.features, record.range});
      continue;
    }
    ++same->members;
    for (int k = 0; k < feature_count(rule.balls); ++k) {
      same->range.low[k] = std::min(same->range.low[k], record.range.low[k]);
      same->range.high[k] = std::max(same->range.high[k], record.range.high[k]);
    }
  }
  std::vector<FeatureBox> boxes;
  for (const Group& group : groups) {
    const FeatureBox box = widened(group.range, rule.balls);
    if (group.members >= members_needed && !admits_balance(box, rule.balls)) boxes.push_back(box);
  }
  return boxes;
}

}  // namespace equipoise
