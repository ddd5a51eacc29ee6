// Limits come first, then objectives.
#include "equipoise/analyses/design/standing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace equipoise {

namespace {

// Larger than any figure, but finite: optimisers calculate with worths.
constexpr double worst_goal = 1e15, first_violation = 1e16;
// For one limit: an infinite figure violates it by this much.
constexpr double largest_violation = 1e6;

}  // namespace

// `up`: whether the good side is the upper one.
double DesignStanding::at(const DesignSample& sample, std::size_t figure, bool up, Side side) const {
  const DesignEstimate& e = sample.figures[figure];
  const double good = up ? e.high : e.low, bad = up ? e.low : e.high;
  const auto part = [&](double end) {
    return std::isfinite(e.value) && std::isfinite(end) ? e.value + 0.5 * (end - e.value) : end;
  };
  switch (side) {
    case Side::hopeful:
      return part(good);
    case Side::doubtful:
      return part(bad);
    case Side::worst:
      return bad;
    default:
      return e.value;
  }
}

double DesignStanding::violation(const DesignLimit& limit, const DesignSample& sample, Side side) const {
  if (sample.figures.empty()) return largest_violation;
  const auto missed = [](double by, double bound) {
    const double part = by / (bound != 0.0 ? std::fabs(bound) : 1.0);
    if (std::isnan(part)) return largest_violation;  // a number that the study itself does not state
    return part > 0.0 ? std::min(part, largest_violation) : 0.0;
  };
  double sum = 0.0;
  if (limit.below) sum += missed(at(sample, limit.figure, false, side) - *limit.below, *limit.below);
  if (limit.above) sum += missed(*limit.above - at(sample, limit.figure, true, side), *limit.above);
  return sum;
}

double DesignStanding::violation(const DesignSample& sample, Side side) const {
  if (sample.figures.empty()) return largest_violation * static_cast<double>(problem_.limits().size() + 1);
  double sum = 0.0;
  for (const DesignLimit& limit : problem_.limits()) sum += violation(limit, sample, side);
  return sum;
}

std::vector<double> DesignStanding::goals(const DesignSample& sample, Side side) const {
  std::vector<double> goals;
  for (const std::size_t k : problem_.objectives()) {
    if (sample.figures.empty()) goals.push_back(worst_goal);
    if (sample.figures.empty()) continue;
    const bool up = problem_.figures()[k].figure.up;
    const double value = at(sample, k, up, side);
    goals.push_back(std::isnan(value) ? worst_goal : std::clamp(up ? -value : value, -worst_goal, worst_goal));
  }
  return goals;
}

std::vector<double> DesignStanding::worth(const DesignSample& sample) const {
  const double missed = violation(sample, Side::worst);
  if (missed > 0.0) return std::vector<double>(problem_.objectives().size(), first_violation * (1.0 + missed));
  return goals(sample, Side::doubtful);
}

bool DesignStanding::beats(const DesignSample& a, Side side_a, const DesignSample& b, Side side_b) const {
  // A limit counts as met only if it certainly is; hopeful assumes that it will be.
  const auto strict = [](Side side) { return side == Side::hopeful ? Side::hopeful : Side::worst; };
  const double missed_a = violation(a, strict(side_a)), missed_b = violation(b, strict(side_b));
  if (missed_a > 0.0 || missed_b > 0.0) return missed_a < missed_b;
  const std::vector<double> goals_a = goals(a, side_a), goals_b = goals(b, side_b);
  bool better = false;
  for (std::size_t k = 0; k < goals_a.size(); ++k) {
    if (goals_a[k] > goals_b[k]) return false;
    better = better || goals_a[k] < goals_b[k];
  }
  return better;
}

std::vector<std::size_t> DesignStanding::order(const std::vector<const DesignSample*>& samples, Side side) const {
  std::vector<std::size_t> places(samples.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  const auto rank = [&](std::size_t k) {
    std::vector<double> key = goals(*samples[k], side);
    const double missed = violation(*samples[k], Side::worst);
    key.insert(key.begin(), missed);
    return key;
  };
  std::vector<std::vector<double>> ranks;
  for (const std::size_t k : places) ranks.push_back(rank(k));
  std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) { return ranks[a] < ranks[b]; });
  return places;
}

std::vector<std::size_t> DesignStanding::front(const std::vector<const DesignSample*>& samples, Side side) const {
  std::vector<std::size_t> members;
  for (const std::size_t k : order(samples, side)) {
    // Nothing is beaten by a later entry in this order, and the first of equals stands for all.
    const bool beaten = std::any_of(members.begin(), members.end(), [&](std::size_t m) {
      return beats(*samples[m], side, *samples[k], side) ||
             (goals(*samples[m], side) == goals(*samples[k], side) && !beats(*samples[k], side, *samples[m], side));
    });
    if (!beaten) members.push_back(k);
  }
  return members;
}

std::size_t DesignStanding::middle(const std::vector<const DesignSample*>& samples) const {
  std::vector<std::vector<double>> all;
  for (const DesignSample* s : samples) all.push_back(goals(*s, Side::estimate));
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < all.size(); ++k) {
    double distance = 0.0;
    for (std::size_t g = 0; g < problem_.objectives().size(); ++g) {
      double low = all[0][g], high = all[0][g];
      for (const auto& one : all) low = std::min(low, one[g]), high = std::max(high, one[g]);
      const double part = high > low ? (all[k][g] - low) / (high - low) : 0.0;
      distance += part * part;
    }
    if (distance < least) nearest = k, least = distance;
  }
  return nearest;
}

}  // namespace equipoise
