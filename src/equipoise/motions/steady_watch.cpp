// Steadiness by trends over parts of time, and the kinds of steady motion.
#include "equipoise/motions/steady_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "equipoise/base/angles.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/motions/catalogue.hpp"

namespace equipoise {

namespace {

constexpr int parts = 8;
using Series = std::array<double, parts>;

// Block lengths: two turns of the rotor, but no shorter than a few periods of the supports, and no longer than it would
// take to wait for a rotor that hardly turns.
constexpr double shortest_block = 16.0, longest_block = 100.0, block_turns = 2.0;
// Balls rest if no rate exceeds this share of the rotor's speed; more is rocking, once a revolution, under gravity.
constexpr double resting_rate = 0.1;
// Ids of kinds, those of motion_name() where it has one.
constexpr int drifting = 2, apart = 3, one_captured = 4, pair_drift = 6, locked = 7, different_rates = first_free_id,
              hanging = first_free_id + 1;
constexpr int captured_id(int captured) { return captured == 1 ? one_captured : first_free_id + captured; }

double range(const Series& v) {
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  return *high - *low;
}

// Pairs in rising order less pairs in falling order: 28 if each part exceeds the one before. Of eight numbers in random
// order one in 71 reaches 20, one in 180 reaches 22 and one in 576 reaches 24 (either sign). What grows or shrinks
// steadily reaches 28, and 24 with two neighbours exchanged by chance.
constexpr int trend = 24;
int kendall(const Series& v) {
  int s = 0;
  for (int i = 0; i < parts; ++i)
    for (int k = 0; k < i; ++k) s += (v[i] > v[k]) - (v[i] < v[k]);
  return s;
}

// Grows or shrinks from part to part, and by more than `floor` altogether.
bool trends(const Series& v, double floor) { return std::abs(kendall(v)) >= trend && range(v) > floor; }

enum class Drift { none, some, unclear };

// Whether an angle that turned by so much in each part drifts: it has gone right round, evenly. Between half a turn and
// that it may be either; so it may while a small angle keeps its sense. Many slips to and fro, as in chaos, add up to
// turns that mean nothing.
Drift drift_of(const Series& turned, double small) {
  double sum = 0.0, squares = 0.0;
  int forward = 0;
  for (const double v : turned) {
    sum += v;
    squares += v * v;
    forward += v > 0.0;
  }
  const double mean = sum / parts;
  const double error = std::sqrt(std::max(0.0, squares / parts - mean * mean) / (parts - 1));
  if (std::fabs(sum) > two_pi && std::fabs(mean) > 4.0 * error) return Drift::some;
  const bool keeps_sense = forward == 0 || forward == parts;
  if (std::fabs(sum) <= pi && (std::fabs(sum) <= small || !keeps_sense)) return Drift::none;
  if (!keeps_sense && std::fabs(mean) < 2.0 * error) return Drift::none;
  return Drift::unclear;
}

using Parts = std::array<SteadyStretch, parts>;

Series turned_by(const Parts& part, int ball) {
  Series v;
  for (int k = 0; k < parts; ++k) v[k] = part[k].ball[ball].turned;
  return v;
}

// Of balls that drift at one rate. What happens in some parts and not in others is not told yet.
int kind_at_one_rate(const model::Parameters& p, const Parts& part, const std::array<double, model::max_balls>& phi) {
  const auto passing =
      std::count_if(part.begin(), part.end(), [](const SteadyStretch& s) { return s.oppositions > 0; });
  if (passing == 0) {
    // Balls spread all around the race pass no opposite places either.
    bool on_one_side = true;
    for (int i = 0; i < p.balls; ++i)
      for (int k = 0; k < i; ++k)
        on_one_side = on_one_side && std::fabs(wrapped(phi[i] - phi[0]) - wrapped(phi[k] - phi[0])) < pi;
    return on_one_side ? drifting : apart;
  }
  if (passing < parts) return 0;
  if (p.balls > 2) return apart;
  double oppositions = 0.0, turned = 0.0;
  for (const SteadyStretch& s : part) {
    oppositions += s.oppositions;
    turned += 0.5 * (s.ball[0].turned + s.ball[1].turned);
  }
  // As motion_name() tells them; a stretch misses one opposition at most, so that 1.54 a turn, the most seen of balls
  // that drift apart, are not taken for two from five turns on.
  constexpr double twice_a_turn = 1.95, least_turns = 8.0;
  const double turns = std::fabs(turned) / two_pi;
  if (turns < least_turns) return 0;
  return oppositions + 1.0 >= twice_a_turn * turns ? pair_drift : apart;
}

// All balls are left behind by the rotor's own speed: they hang in space.
bool hang(const model::Parameters& p, const Parts& part, double small) {
  if (!model::is_strobed(p)) return false;
  for (int i = 0; i < p.balls; ++i) {
    Series in_space = turned_by(part, i);
    for (int k = 0; k < parts; ++k) in_space[k] += part[k].turned;
    if (drift_of(in_space, small) == Drift::some) return false;
  }
  return true;
}

// Of the balls: how many are captured, and how the others drift. 0: not told yet. `phi`: where they are.
int kind_of(const model::Parameters& p, const Parts& part, const std::array<double, model::max_balls>& phi,
            double small) {
  int captured = 0;
  for (int i = 0; i < p.balls; ++i) {
    const Drift drift = drift_of(turned_by(part, i), small);
    if (drift == Drift::unclear) return 0;
    captured += drift == Drift::none;
  }
  if (captured == p.balls) return locked;
  if (captured > 0) return captured_id(captured);
  if (hang(p, part, small)) return hanging;
  for (int i = 1; i < p.balls; ++i) {
    Series ahead = turned_by(part, i);
    const Series first = turned_by(part, 0);
    for (int k = 0; k < parts; ++k) ahead[k] -= first[k];
    const Drift drift = drift_of(ahead, small);
    if (drift == Drift::unclear) return 0;
    if (drift == Drift::some) return different_rates;
  }
  return kind_at_one_rate(p, part, phi);
}

}  // namespace

std::vector<SteadyKind> steady_kinds(int balls) {
  std::vector<SteadyKind> kinds;
  kinds.reserve(model::max_balls + 8);
  kinds.push_back({balanced_id, "balanced"});
  if (balls == 1) return {kinds.front(), {drifting, "drifting"}, {locked, "locked"}, {hanging, "hanging"}};
  kinds.insert(kinds.end(), {{drifting, "co-drifting"}, {apart, "drifting apart"}, {one_captured, "one captured"}});
  if (balls == 2) kinds.push_back({pair_drift, "pair drift"});
  kinds.insert(kinds.end(),
               {{locked, "locked"}, {different_rates, "drifting at different rates"}, {hanging, "hanging"}});
  for (int k = 2; k < balls; ++k) kinds.push_back({captured_id(k), std::to_string(k) + " captured"});
  return kinds;
}

void SteadyStretch::add(const SteadyStretch& next) {
  duration += next.duration;
  turned += next.turned;
  r2_min = std::min(r2_min, next.r2_min);
  r2_max = std::max(r2_max, next.r2_max);
  r2_integral += next.r2_integral;
  oppositions += next.oppositions;
  for (int i = 0; i < model::max_balls; ++i) {
    ball[i].turned += next.ball[i].turned;
    ball[i].slowest = std::min(ball[i].slowest, next.ball[i].slowest);
    ball[i].fastest = std::max(ball[i].fastest, next.ball[i].fastest);
  }
}

double SteadyStretch::r_rms() const { return std::sqrt(r2_integral / duration); }

SteadyWatch::SteadyWatch(const model::Parameters& p, bool creeps)
    : p_(p), creeps_(creeps), interchangeable_(p.equal_balls()) {}

void SteadyWatch::begin(double t, double psi, const double* phi) {
  blocks_.clear();
  begin_ = last_ = t;
  begin_psi_ = last_psi_ = psi;
  open(t, psi, phi);
}

void SteadyWatch::open(double t, double psi, const double* phi) {
  open_ = {};
  block_begin_ = t;
  psi_ = psi;
  std::copy(phi, phi + p_.balls, phi_.begin());
  last_phi_ = sampled_ = phi_;
  angle_.fill(0.0);
}

// Since the sample before: what passes more than one opposite place in between turns too fast to be drifting alike.
int SteadyWatch::oppositions_to(const std::array<double, model::max_balls>& phi) {
  const auto half_turns = [](double ahead) { return std::floor((ahead + pi) / two_pi); };
  int passed = 0;
  for (int i = 0; i < p_.balls; ++i)
    for (int k = 0; k < i; ++k) passed += half_turns(phi[i] - phi[k]) != half_turns(sampled_[i] - sampled_[k]);
  sampled_ = phi;
  return passed;
}

bool SteadyWatch::step(double t, double psi, const std::array<SteadySample, 3>& samples) {
  const double* phi = samples.back().phi.data();
  const double h = t - last_;
  last_ = t;
  last_psi_ = psi;
  for (int i = 0; i < p_.balls; ++i) {
    angle_[i] += 0.5 * h * (phi[i] + last_phi_[i]);
    last_phi_[i] = phi[i];
  }
  for (const SteadySample& s : samples) {
    open_.r2_min = std::min(open_.r2_min, s.r2);
    open_.r2_max = std::max(open_.r2_max, s.r2);
    open_.r2_integral += h / 3.0 * s.r2;
    open_.oppositions += oppositions_to(s.phi);
    for (int i = 0; i < p_.balls; ++i) {
      open_.ball[i].slowest = std::min(open_.ball[i].slowest, s.rate[i]);
      open_.ball[i].fastest = std::max(open_.ball[i].fastest, s.rate[i]);
    }
  }
  open_.duration = t - block_begin_;
  open_.turned = psi - psi_;
  const bool turned = std::fabs(open_.turned) >= block_turns * two_pi;
  if (open_.duration < shortest_block || (!turned && open_.duration < longest_block)) return false;
  for (int i = 0; i < p_.balls; ++i) {
    const double mean = angle_[i] / open_.duration;
    open_.ball[i].turned = blocks_.empty() ? phi[i] - phi_[i] : mean - mean_[i];
    mean_[i] = mean;
  }
  blocks_.push_back(open_);
  open(t, psi, phi);
  return true;
}

double SteadyWatch::mean_speed() const {
  if (blocks_.empty()) return last_ > begin_ ? (last_psi_ - begin_psi_) / (last_ - begin_) : 0.0;
  SteadyStretch later;
  for (std::size_t k = blocks_.size() / 2; k < blocks_.size(); ++k) later.add(blocks_[k]);
  return later.speed();
}

SteadyLook SteadyWatch::look() const {
  SteadyLook look;
  const std::size_t each = blocks_.size() / 2 / parts;
  look.enough = each > 0;
  if (!look.enough) return look;
  Parts part, by_ball;
  SteadyStretch all;
  for (int k = 0; k < parts; ++k) {
    const std::size_t first = blocks_.size() - (parts - k) * each;
    for (std::size_t i = first; i < first + each; ++i) part[k].add(blocks_[i]);
    all.add(part[k]);
    by_ball[k] = part[k];
    // Equal balls may take each other's places: that is no trend.
    if (interchangeable_)
      std::sort(part[k].ball.begin(), part[k].ball.begin() + p_.balls,
                [](const SteadyStretch::Ball& a, const SteadyStretch::Ball& b) { return a.turned < b.turned; });
  }
  const auto series = [&](auto&& value) {
    Series v;
    for (int k = 0; k < parts; ++k) v[k] = value(part[k]);
    return v;
  };
  look.speed = all.speed();
  look.r_rms = all.r_rms();
  const double size = std::max(std::fabs(look.speed), 1e-3);
  const Series speeds = series([](const SteadyStretch& s) { return std::fabs(s.speed()); });
  // Mean speeds of eight parts wander by a few per cent in chaos; a trend of a ten thousandth has not come to its end.
  look.speed_steady = range(speeds) < 0.03 * size && !trends(speeds, 1e-4 * size);
  look.slowing = kendall(speeds) <= -trend;
  look.quickening = kendall(speeds) >= trend;
  // Three samples a step tell an extreme to a per cent or two; what trends within a thousandth is told by no sample.
  bool trending = false, same = true;
  const auto judge = [&](const Series& v, double unit) {
    trending = trending || trends(v, 1e-3 * unit);
    same = same && range(v) < 0.02 * unit;
  };
  // What is at rest on the axis up to the errors of steps, a millionth of the unbalances, has nothing left to compare.
  const double r = look.r_rms + 1e-5 * p_.all_unbalances();
  judge(series([](const SteadyStretch& s) { return s.r_rms(); }), r);
  judge(series([](const SteadyStretch& s) { return std::sqrt(s.r2_max); }), r);
  judge(series([](const SteadyStretch& s) { return std::sqrt(s.r2_min); }), r);
  bool slow = true;
  for (int i = 0; i < p_.balls; ++i) {
    judge(series([i](const SteadyStretch& s) { return s.ball[i].slowest; }), size);
    judge(series([i](const SteadyStretch& s) { return s.ball[i].fastest; }), size);
    const double fastest = std::max(std::fabs(all.ball[i].slowest), std::fabs(all.ball[i].fastest));
    slow = slow && fastest <= resting_rate * size;
    look.swinging = look.swinging || fastest > 1e-3 * size;
  }
  const double small = slow && creeps_ ? 0.25 * pi : 0.05;
  look.kind = kind_of(p_, by_ball, sampled_, small);
  look.resting = look.kind == locked && slow;
  for (int i = 0; i < p_.balls; ++i) {
    const Series turned = turned_by(by_ball, i);
    const double sum = std::fabs(all.ball[i].turned);
    if (!look.resting || !creeps_) trending = trending || trends(turned, 0.005 + 1e-3 * sum);
    same = same && range(turned) < (look.resting ? small : two_pi + 0.02 * sum / parts);
  }
  look.trending = trending;
  look.repeats = same && !trending && range(speeds) < 0.002 * size;
  return look;
}

}  // namespace equipoise
