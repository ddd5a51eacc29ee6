// Windows of time: features, boxes, stationarity.
#include "equipoise/attractors/window_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace equipoise {

namespace {

// Below this a ball counts as at rest when rates are compared: a hundredth of a radian in half a time unit of the
// rotor.
constexpr double rest_rate = 0.02;

void extend(WindowSums& whole, const WindowSums& part, int balls, bool fresh) {
  if (fresh) {
    whole = part;
    return;
  }
  whole.duration += part.duration;
  whole.r2_min = std::min(whole.r2_min, part.r2_min);
  whole.r2_max = std::max(whole.r2_max, part.r2_max);
  whole.r2_integral += part.r2_integral;
  for (int i = 0; i < balls; ++i) {
    whole.turned[i] += part.turned[i];
    whole.q_min[i] = std::min(whole.q_min[i], part.q_min[i]);
    whole.q_max[i] = std::max(whole.q_max[i], part.q_max[i]);
  }
}

bool inside(const FeatureBox& box, const Features& f, int count) {
  for (int i = 0; i < count; ++i)
    if (!(f[i] >= box.low[i] && f[i] <= box.high[i])) return false;
  return true;
}

}  // namespace

Features features(const WindowSums& sums, int balls, bool interchangeable) {
  std::array<int, model::max_balls> order{};
  for (int i = 0; i < balls; ++i) order[i] = i;
  for (int i = 1; interchangeable && i < balls; ++i)  // insertion sort: eight entries at most
    for (int k = i; k > 0 && sums.turned[order[k]] < sums.turned[order[k - 1]]; --k) std::swap(order[k], order[k - 1]);
  Features f{std::sqrt(sums.r2_min), std::sqrt(sums.r2_max), std::sqrt(sums.r2_integral / sums.duration)};
  for (int k = 0; k < balls; ++k) {
    const int i = order[k];
    f[3 + 3 * k] = sums.turned[i] / sums.duration;
    f[4 + 3 * k] = sums.q_min[i];
    f[5 + 3 * k] = sums.q_max[i];
  }
  return f;
}

bool same_motion(const Features& a, const Features& b, int balls, double sameness) {
  // Extremes of phi' over all balls together: on a torus each ball alone may take very long to show its own.
  const auto slowest = [&](const Features& f) {
    double q = f[4];
    for (int i = 1; i < balls; ++i) q = std::min(q, f[4 + 3 * i]);
    return q;
  };
  const auto fastest = [&](const Features& f) {
    double q = f[5];
    for (int i = 1; i < balls; ++i) q = std::max(q, f[5 + 3 * i]);
    return q;
  };
  const auto close = [&](double p, double q, double scale) { return std::fabs(p - q) <= sameness * scale; };
  const double rate =
      std::max({rest_rate, std::fabs(slowest(a)), std::fabs(slowest(b)), std::fabs(fastest(a)), std::fabs(fastest(b))});
  const double radius = std::max(a[1], b[1]);
  bool same = close(slowest(a), slowest(b), rate) && close(fastest(a), fastest(b), rate);
  // r passes its minimum like |t|, so samples a fraction of a step apart miss it by far more than they miss the
  // maximum.
  same = same && close(a[0], b[0], 2.0 * radius) && close(a[1], b[1], radius) && close(a[2], b[2], radius);
  for (int i = 0; i < balls; ++i) same = same && close(a[3 + 3 * i], b[3 + 3 * i], rate);
  return same;
}

void WindowTracker::begin(const DecisionRule& rule) {
  rule_ = &rule;
  elapsed_ = 0.0;
  long_end_ = rule.first_long_window;
  box_ = -1;
  hits_ = repeats_ = 0;
  fresh_ = true;
  has_previous_ = false;
}

WindowVerdict WindowTracker::add(const WindowSums& sums) {
  const int balls = rule_->balls;
  const int count = feature_count(balls);
  const Features f = features(sums, balls, rule_->interchangeable);
  elapsed_ += sums.duration;

  int box = box_ >= 0 && inside(rule_->boxes[box_], f, count) ? box_ : -1;
  for (std::size_t b = 0; box < 0 && b < rule_->boxes.size(); ++b)
    if (inside(rule_->boxes[b], f, count)) box = static_cast<int>(b);
  hits_ = box < 0 ? 0 : box == box_ ? hits_ + 1 : 1;
  box_ = box;

  extend(long_, sums, balls, fresh_);
  if (fresh_) {
    range_ = {f, f};
  } else {
    for (int i = 0; i < count; ++i) {
      range_.low[i] = std::min(range_.low[i], f[i]);
      range_.high[i] = std::max(range_.high[i], f[i]);
    }
  }
  fresh_ = false;

  if (hits_ >= rule_->hits_needed) return WindowVerdict::known;
  return elapsed_ >= long_end_ ? finish_long_window() : WindowVerdict::open;
}

WindowVerdict WindowTracker::finish_long_window() {
  const Features f = features(long_, rule_->balls, rule_->interchangeable);
  const bool repeats = has_previous_ && same_motion(previous_, f, rule_->balls, rule_->sameness);
  previous_ = f;
  has_previous_ = true;
  long_end_ *= 2.0;
  fresh_ = true;
  repeats_ = repeats ? repeats_ + 1 : 0;
  return repeats_ >= rule_->repeats_needed ? WindowVerdict::stationary : WindowVerdict::open;
}

}  // namespace equipoise
