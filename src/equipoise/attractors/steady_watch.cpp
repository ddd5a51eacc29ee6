// Steadiness by windows of time, and the kinds of steady motion.
#include "equipoise/attractors/steady_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "equipoise/attractors/catalogue.hpp"

namespace equipoise {

namespace {

// Balls whose mean rate is below this share of the rotor's speed stay where they are: over a window of a hundred time
// units they would turn by a tenth of a radian for every time unit that the rotor needs for a radian.
constexpr double captured_rate = 1e-3;
// Balls rest if no rate exceeds this share of the rotor's speed; more is rocking, once a revolution, under gravity.
constexpr double resting_rate = 0.1;
// Mean speeds of two windows that count as one.
constexpr double same_speed = 0.005;
// A torus or chaos shows other extremes in every window. It is told by its kind alone after so many windows, each twice
// as long as the one before: 1500 time units at common speeds.
constexpr int most_kind_repeats = 4;
// Towards balance: how near in bare responses, how slow in rotor speeds, and the shrinking from one window to the next.
constexpr double near_balance = 0.05, slow_balls = 0.01, shrinking = 0.7;

}  // namespace

double bare_response(const model::Parameters& p, double speed) {
  const double stiffness = 0.5 * (p.stiffness[0] + p.stiffness[1]), damping = 0.5 * (p.damping[0] + p.damping[1]);
  return p.eccentricity * speed * speed / std::hypot(stiffness - speed * speed, damping * speed);
}

SteadyKind steady_kind(const model::Parameters& p, const Features& f, double speed) {
  const double size = std::max(std::fabs(speed), 1e-3);
  int captured = 0;
  bool resting = true, alike = true;
  for (int i = 0; i < p.balls; ++i) {
    const double mean = f[3 + 3 * i], slowest = f[4 + 3 * i], fastest = f[5 + 3 * i];
    captured += std::fabs(mean) <= captured_rate * size;
    resting = resting && std::max(std::fabs(slowest), std::fabs(fastest)) <= resting_rate * size;
    alike = alike && std::fabs(mean - f[3]) <= captured_rate * size + 0.02 * std::fabs(mean);
  }
  const std::vector<SteadyKind> kinds = steady_kinds(p.balls);
  const auto kind = [&](const std::string& name) {
    return *std::find_if(kinds.begin(), kinds.end(), [&](const SteadyKind& k) { return k.name == name; });
  };
  if (captured == p.balls && resting)
    return kind(f[1] < 0.5 * bare_response(p, speed) || f[1] < 1e-6 ? "balanced" : "locked");
  if (captured == p.balls) return kind("locked");
  if (captured > 0) return kind(captured == 1 ? "one captured" : std::to_string(captured) + " captured");
  return kind(p.balls == 1 ? "drifting" : alike ? "co-drifting" : "drifting apart");
}

std::vector<SteadyKind> steady_kinds(int balls) {
  std::vector<SteadyKind> kinds{{1, "balanced"}};
  if (balls == 1)
    kinds.push_back({2, "drifting"});
  else
    kinds.insert(kinds.end(), {{2, "co-drifting"}, {3, "drifting apart"}, {4, "one captured"}});
  kinds.push_back({7, "locked"});
  for (int k = 2; k < balls; ++k) kinds.push_back({first_free_id + k - 2, std::to_string(k) + " captured"});
  return kinds;
}

SteadyWatch::SteadyWatch(const model::Parameters& p, double typical_speed) : p_(p) {
  rule_.balls = p.balls;
  rule_.interchangeable = p.equal_balls();
  rule_.window = std::max(16.0, 32.0 / std::max(std::fabs(typical_speed), 0.1));
  rule_.first_long_window = std::max(100.0, 6.0 * rule_.window);
}

void SteadyWatch::begin(double t, double psi, const double* phi) {
  begin_ = last_ = long_begin_ = t;
  long_end_ = t + rule_.first_long_window;
  long_psi_ = psi;
  open_half(t, phi);
  tracker_.begin(rule_);
  speed_repeats_ = 0;
  repeats_ = speed_windows_ = kind_repeats_ = kind_ = 0;
  has_features_ = false;
  largest_r_ = fastest_ = 0.0;
  previous_r_ = previous_fastest_ = 1e300;
}

bool SteadyWatch::step(double t, double psi, const double* phi, const std::array<SteadySample, 3>& samples) {
  const double h = t - last_;
  last_ = t;
  for (const SteadySample& s : samples) {
    sums_.r2_min = std::min(sums_.r2_min, s.r2);
    sums_.r2_max = std::max(sums_.r2_max, s.r2);
    sums_.r2_integral += h / 3.0 * s.r2;
    largest_r_ = std::max(largest_r_, s.r2);
    for (int i = 0; i < p_.balls; ++i) {
      sums_.q_min[i] = std::min(sums_.q_min[i], s.rate[i]);
      sums_.q_max[i] = std::max(sums_.q_max[i], s.rate[i]);
      fastest_ = std::max(fastest_, std::fabs(s.rate[i]));
    }
  }
  if (t - half_begin_ < 0.5 * rule_.window) return false;
  finish_half(t, phi);
  return t >= long_end_ && finish_long(t, psi);
}

void SteadyWatch::finish_half(double t, const double* phi) {
  sums_.duration = t - half_begin_;
  for (int i = 0; i < p_.balls; ++i) sums_.turned[i] = phi[i] - half_phi_[i];
  tracker_.add(sums_);  // its long windows end with the same half windows as those here
  open_half(t, phi);
}

void SteadyWatch::open_half(double t, const double* phi) {
  half_begin_ = t;
  std::copy(phi, phi + p_.balls, half_phi_.begin());
  sums_ = {};
  sums_.r2_min = 1e300;
  sums_.q_min.fill(1e300);
  sums_.q_max.fill(-1e300);
}

bool SteadyWatch::finish_long(double t, double psi) {
  const double speed = (psi - long_psi_) / (t - long_begin_);
  const bool fresh = speed_windows_ == 0;
  const double before_speed = mean_speed_;
  const bool same = !fresh && std::fabs(speed - before_speed) <= same_speed * std::fabs(speed);
  ++speed_windows_;
  speed_repeats_ = same ? speed_repeats_ + 1 : 0;
  mean_speed_ = speed;
  const Features before = std::exchange(features_, tracker_.record().features);
  repeats_ = !fresh && repeats(before) ? repeats_ + 1 : 0;
  has_features_ = true;
  const double r = std::sqrt(largest_r_), bare = bare_response(p_, speed);
  const bool nearly_same = !fresh && std::fabs(speed - before_speed) <= 4.0 * same_speed * std::fabs(speed);
  const bool balancing = nearly_same && r < near_balance * bare && fastest_ < slow_balls * std::fabs(speed) &&
                         r < shrinking * previous_r_ && fastest_ < shrinking * previous_fastest_;
  previous_r_ = r;
  previous_fastest_ = fastest_;
  largest_r_ = fastest_ = 0.0;
  long_begin_ = t;
  long_psi_ = psi;
  long_end_ = begin_ + 2.0 * (long_end_ - begin_);
  if (!fresh && !same) {
    // On its way to another speed: what will repeat begins here, with short windows again.
    begin_ = t;
    long_end_ = t + rule_.first_long_window;
    tracker_.begin(rule_);
    repeats_ = 0;
  }
  const int kind = steady_kind(p_, features_, speed).id;
  kind_repeats_ = same && kind == kind_ && kind != balanced_id ? kind_repeats_ + 1 : 0;
  kind_ = kind;
  return balancing || (speed_repeats() && (repeats_ >= 2 || kind_repeats_ >= most_kind_repeats));
}

// Balls at rest and a rotor that is almost still repeat themselves only up to the errors of integration, which are no
// smaller for being all that moves.
bool SteadyWatch::repeats(const Features& before) const {
  const auto at_rest = [&](const Features& f) {
    bool rest = true;
    for (int i = 0; i < p_.balls; ++i)
      rest = rest && std::max(std::fabs(f[4 + 3 * i]), std::fabs(f[5 + 3 * i])) < slow_balls * std::fabs(mean_speed_);
    return rest;
  };
  const double small = 0.01 * bare_response(p_, mean_speed_);
  bool same_r = true;
  for (int k = 0; k < 3; ++k) same_r = same_r && std::fabs(features_[k] - before[k]) < small;
  return same_motion(before, features_, p_.balls, rule_.sameness) || (same_r && at_rest(before) && at_rest(features_));
}

}  // namespace equipoise
