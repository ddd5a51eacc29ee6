// Windows of time: features, boxes, stationarity.
#include "equipoise/simulation/rule/window_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "equipoise/simulation/batch/own_rotor.hpp"

namespace equipoise {

namespace {

// A ball slower than this counts as at rest when rates are compared: a hundredth of a radian in half a time unit.
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
  whole.rotor_turned += part.rotor_turned;
  whole.speed_min = std::min(whole.speed_min, part.speed_min);
  whole.speed_max = std::max(whole.speed_max, part.speed_max);
}

void extend(FeatureBox& range, const Features& f, int count, bool fresh) {
  for (int i = 0; i < count; ++i) {
    range.low[i] = fresh ? f[i] : std::min(range.low[i], f[i]);
    range.high[i] = fresh ? f[i] : std::max(range.high[i], f[i]);
  }
}

double largest_speed(const Features& f, int balls) {
  return std::max(std::fabs(f[speed_feature(balls) + 1]), std::fabs(f[speed_feature(balls) + 2]));
}

}  // namespace

bool inside(const FeatureBox& box, const Features& f, int balls, const double* shifts) {
  const int count = feature_count(balls);
  const double* shift = shifts && box.trend >= 0 ? shifts + box.trend * count : nullptr;
  for (int i = 0; i < count; ++i) {
    const double value = shift ? f[i] - shift[i] : f[i];
    if (!(value >= box.low[i] && value <= box.high[i])) return false;
  }
  return true;
}

Features features(const WindowSums& sums, int balls, bool interchangeable) {
  std::array<int, model::max_balls> order{};
  for (int i = 0; i < balls; ++i) order[i] = i;
  for (int i = 1; interchangeable && i < balls; ++i)  // insertion sort: few entries
    for (int k = i; k > 0 && sums.turned[order[k]] < sums.turned[order[k - 1]]; --k) std::swap(order[k], order[k - 1]);
  Features f{std::sqrt(sums.r2_min), std::sqrt(sums.r2_max), std::sqrt(sums.r2_integral / sums.duration)};
  for (int k = 0; k < balls; ++k) {
    const int i = order[k];
    f[3 + 3 * k] = sums.turned[i] / sums.duration;
    f[4 + 3 * k] = sums.q_min[i];
    f[5 + 3 * k] = sums.q_max[i];
  }
  const int speed = speed_feature(balls);
  f[speed] = sums.rotor_turned / sums.duration;
  f[speed + 1] = sums.speed_min;
  f[speed + 2] = sums.speed_max;
  return f;
}

bool same_motion(const Features& a, const Features& b, int balls, double sameness) {
  // Extremes of phi' over all balls together: on a torus a single ball may take very long to show its own.
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
  // r passes its minimum like |t|. Samples a fraction of a step apart therefore miss the minimum by far more than the
  // maximum.
  same = same && close(a[0], b[0], 2.0 * radius) && close(a[1], b[1], radius) && close(a[2], b[2], radius);
  for (int i = 0; i < balls; ++i) same = same && close(a[3 + 3 * i], b[3 + 3 * i], rate);
  const int speed = speed_feature(balls);
  const double fastest_turn = std::max(largest_speed(a, balls), largest_speed(b, balls));
  for (int k = speed; k < speed + 3; ++k) same = same && close(a[k], b[k], fastest_turn);
  return same;
}

Features brought_back(const Features& f, int trend, const double* shifts, int balls) {
  Features result = f;
  const int count = feature_count(balls);
  if (shifts && trend >= 0)
    for (int k = 0; k < count; ++k) result[k] -= shifts[trend * count + k];
  return result;
}

namespace {

// Whether the radius in a rotor's window is less than half of that of its motion, which is `at_middle` at the middle:
// then balance is nearer. If that motion causes little vibration on this rotor, the window may agree with both.
bool is_nearer_balance(double radius, double at_middle, int attractor, int trend, const double* shifts, int balls) {
  if (attractor == balanced_id || !shifts || trend < 0) return false;
  return radius < 0.5 * std::fabs(at_middle + shifts[trend * feature_count(balls) + 1]);
}

// How far chaos in two windows differs in its means: rms r, mean rates of balls, mean psi'; the largest difference as a
// share of the largest such mean. Extremes of chaos grow with the length of the window.
double difference_in_means(const Features& a, const Features& b, int balls) {
  const int speed = speed_feature(balls);
  double rate = rest_rate, apart = 0.0;
  for (int i = 3; i < speed; i += 3) {
    rate = std::max({rate, std::fabs(a[i]), std::fabs(b[i])});
    apart = std::max(apart, std::fabs(a[i] - b[i]));
  }
  const auto share = [&](int k) {
    const double most = std::max(std::fabs(a[k]), std::fabs(b[k]));
    return most > 0.0 ? std::fabs(a[k] - b[k]) / most : 0.0;
  };
  return std::max({apart / rate, share(2), share(speed)});
}

}  // namespace

const KnownFeatures* nearest_known(const Features& own, const std::vector<KnownFeatures>& known, int balls,
                                   const double* shifts, double tolerance) {
  const KnownFeatures* nearest = nullptr;
  int first = 0;  // the attractor of the first one that agrees
  double least = std::numeric_limits<double>::infinity();
  for (const KnownFeatures& k : known) {
    const Features f = brought_back(own, k.trend, shifts, balls);
    if (!same_motion(k.features, f, balls, tolerance)) continue;
    if (is_nearer_balance(own[1], k.features[1], k.attractor, k.trend, shifts, balls)) continue;
    // Where rotors differ, two motions that look alike may be one motion before and after a bifurcation.
    if (shifts && tolerance <= known_tolerance && first && first != k.attractor) return nullptr;
    first = k.attractor;
    double distance = 0.0;
    for (int i = 0; i < feature_count(balls); ++i) distance += std::fabs(k.features[i] - f[i]);
    if (distance < least) {
      least = distance;
      nearest = &k;
    }
  }
  return nearest;
}

const KnownFeatures* nearest_met(const Features& f, const std::vector<KnownFeatures>& met, int balls, double sameness) {
  const KnownFeatures* nearest = nearest_known(f, met, balls);
  return nearest && (nearest->chaotic || same_motion(nearest->features, f, balls, sameness)) ? nearest : nullptr;
}

void WindowTracker::begin(const ClassificationRule& rule, const OwnRotor* own) {
  rule_ = &rule;
  own_ = own;
  elapsed_ = 0.0;
  long_end_ = rule.first_long_window;
  repeats_ = chaotic_ = chaotic_repeats_ = 0;
  has_half_ = has_previous_ = false;
  fresh_ = fresh_range_ = true;
  runs_.fill(0);
  longest_.fill(0);
}

WindowConclusion WindowTracker::add(const WindowSums& half) {
  const int balls = rule_->balls;
  elapsed_ += half.duration;
  extend(long_, half, balls, fresh_);
  fresh_ = false;
  if (has_half_) {
    WindowSums whole = half_;
    extend(whole, half, balls, false);
    const Features f = features(whole, balls, rule_->interchangeable);
    extend(range_, f, feature_count(balls), fresh_range_);
    fresh_range_ = false;
    for (std::size_t b = 0; b < rule_->boxes.size(); ++b) {
      const FeatureBox& box = rule_->boxes[b];
      runs_[b] = shows(box, f) ? runs_[b] + 1 : 0;
      longest_[b] = std::max(longest_[b], runs_[b]);
    }
  }
  half_ = half;
  has_half_ = true;
  if (!rule_->blind)
    if (const int attractor = attractor_now()) return {true, attractor};
  return elapsed_ >= long_end_ ? finish_long_window() : WindowConclusion{};
}

bool WindowTracker::shows(const FeatureBox& box, const Features& f) const {
  const int balls = rule_->balls;
  return inside(box, f, balls, shifts_of(own_)) &&
         !is_nearer_balance(f[1], 0.5 * (box.low[1] + box.high[1]), box.attractor, box.trend, shifts_of(own_), balls);
}

int WindowTracker::attractor_now() const {
  for (std::size_t b = 0; b < rule_->boxes.size(); ++b)
    if (runs_[b] >= rule_->boxes[b].hits_needed && !may_end(rule_->boxes[b].chaos)) return rule_->boxes[b].attractor;
  return 0;
}

int WindowTracker::attractor_at_end() const {
  if (const int attractor = attractor_now()) return attractor;
  const KnownFeatures* known = has_previous_ ? known_by(previous_) : nullptr;
  return known && !may_end(known->chaos) ? known->attractor : 0;
}

int WindowTracker::settled_at_end() const {
  // Over a shorter time chaos shows a known motion now and then.
  constexpr double short_windows = 100.0;
  if (!has_previous_) return 0;
  const int balls = rule_->balls;
  WindowSums lately = long_;
  if (!fresh_ && long_.duration < 0.5 * previous_sums_.duration) extend(lately, previous_sums_, balls, false);
  if (lately.duration < short_windows * rule_->window) return 0;
  const Features f = features(lately, balls, rule_->interchangeable);
  const KnownFeatures* known = known_by(f);
  const bool shown =
      known && !known->chaotic &&
      same_motion(known->features, brought_back(f, known->trend, shifts_of(own_), balls), balls, rule_->sameness);
  return shown ? known->attractor : 0;
}

int WindowTracker::chaos_at_end() const {
  const KnownFeatures* chaos = has_previous_ ? nearest_chaos(previous_) : nullptr;
  return chaos ? chaos->attractor : 0;
}

double WindowTracker::mean_speed() const {
  if (has_previous_) return previous_[speed_feature(rule_->balls)];
  return has_half_ ? long_.rotor_turned / long_.duration : std::numeric_limits<double>::quiet_NaN();
}

PilotRecord WindowTracker::record() const {
  PilotRecord record;
  record.features = previous_;
  record.range = previous_range_;
  record.finished_window = has_previous_;
  record.longest_run = longest_;
  return record;
}

WindowConclusion WindowTracker::finish_long_window() {
  const Features f = features(long_, rule_->balls, rule_->interchangeable);
  const bool repeats = has_previous_ && same_motion(previous_, f, rule_->balls, rule_->sameness);
  previous_ = f;
  previous_sums_ = long_;
  previous_range_ = range_;
  has_previous_ = true;
  long_end_ *= 2.0;
  fresh_ = fresh_range_ = true;
  repeats_ = repeats ? repeats_ + 1 : 0;
  const KnownFeatures* known = known_by(f);
  const int chaotic = chaos_in(f, known);
  chaotic_repeats_ = chaotic && chaotic == chaotic_ ? chaotic_repeats_ + 1 : 0;
  chaotic_ = chaotic;
  if (repeats_ < rule_->repeats_needed && chaotic_repeats_ < rule_->repeats_needed) return {};
  if (repeats_ < rule_->repeats_needed) return {true, chaotic};
  if (known && may_end(known->chaos)) return {};
  return {true, known ? known->attractor : 0};
}

bool WindowTracker::may_end(int chaos) const {
  if (chaos < 0 || elapsed_ >= rule_->chaos_lasts) return false;
  const std::size_t number = static_cast<std::size_t>(chaos);
  return !(own_ && number < own_->chaos_lasts.size() && own_->chaos_lasts[number]);
}

const KnownFeatures* WindowTracker::known_by(const Features& f) const {
  if (own_ && own_->met) return nearest_met(f, *own_->met, rule_->balls, rule_->sameness);
  return nearest_known(f, rule_->known, rule_->balls, shifts_of(own_));
}

const KnownFeatures* WindowTracker::nearest_chaos(const Features& f) const {
  constexpr double other_window = 0.3;  // how far the means of one chaos may differ, also between two rotors
  const KnownFeatures* nearest = nullptr;
  if (own_ && own_->met) return nearest;  // its own chaos is known
  double least = other_window;
  for (const KnownFeatures& k : rule_->known) {
    if (!k.chaotic) continue;
    const Features back = brought_back(f, k.trend, shifts_of(own_), rule_->balls);
    const double apart = difference_in_means(k.features, back, rule_->balls);
    if (apart >= least) continue;
    least = apart;
    nearest = &k;
  }
  return nearest;
}

int WindowTracker::chaos_in(const Features& f, const KnownFeatures* known) const {
  const bool has_lasted = rule_->chaos_lasts > 0.0 && elapsed_ >= rule_->chaos_lasts;
  if (!known && has_lasted && repeats_ == 0) known = nearest_chaos(f);
  return known && known->chaotic && !may_end(known->chaos) ? known->attractor : 0;
}

}  // namespace equipoise
