// Follows a trajectory by adaptive DOP853; compares two stretches. Means of increments are smoothly weighted for regular
// motion, and plain with errors from blocks for chaos.
#include "equipoise/attractors/motions/motion_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "equipoise/attractors/motions/gather_motion.hpp"
#include "equipoise/attractors/periodic_orbits/tangent_flow-inl.hpp"

namespace equipoise {

namespace kernels = HWY_NAMESPACE;

void AngleHistory::add_distance(double angle) {
  const double distance = std::fabs(angle - two_pi * std::floor(angle / two_pi + 0.5));  // faster than wrapped()
  farthest = std::max(farthest, distance);
}

void AngleHistory::add(double angle) {
  const long from = static_cast<long>(std::floor(last_ / pi)), to = static_cast<long>(std::floor(angle / pi));
  for (long k = from; k != to;) {
    const long crossed = to > from ? ++k : k--;
    if (crossed % 2 != 0) ++passed_pi;
  }
  add_distance(last_ = angle);
}

bool similar(const MotionStatistics& a, const MotionStatistics& b, int n, double share_of_extremes,
             double share_of_means) {
  const auto close = [](double f, double g, double within) { return std::fabs(f - g) <= within; };
  double rate = 0.0;
  for (int i = 0; i < n; ++i) rate = std::max({rate, std::fabs(b.rate_min[i]), std::fabs(b.rate_max[i])});
  bool same = close(a.r_max, b.r_max, share_of_extremes * b.r_max) &&
              close(a.r_min, b.r_min, share_of_extremes * b.r_max) &&
              close(a.r_mean(), b.r_mean(), share_of_means * b.r_mean());
  double slowest_a = 0.0, slowest_b = 0.0, fastest_a = 0.0, fastest_b = 0.0, drift_a = 0.0, drift_b = 0.0;
  for (int i = 0; i < n; ++i) {
    slowest_a = std::min(slowest_a, a.rate_min[i]);
    slowest_b = std::min(slowest_b, b.rate_min[i]);
    fastest_a = std::max(fastest_a, a.rate_max[i]);
    fastest_b = std::max(fastest_b, b.rate_max[i]);
    drift_a += a.turned[i] / (a.duration * n);
    drift_b += b.turned[i] / (b.duration * n);
  }
  same = same && close(slowest_a, slowest_b, share_of_extremes * rate) &&
         close(fastest_a, fastest_b, share_of_extremes * rate) &&
         close(drift_a, drift_b, share_of_means * rate + two_pi / a.duration);
  // psi' of a driven rotor.
  if (!(b.drive.speed_max >= b.drive.speed_min)) return same;
  const double fastest = std::max(std::fabs(b.drive.speed_min), std::fabs(b.drive.speed_max));
  return same && close(a.drive.speed_min, b.drive.speed_min, share_of_extremes * fastest) &&
         close(a.drive.speed_max, b.drive.speed_max, share_of_extremes * fastest) &&
         close(a.speed_mean(), b.speed_mean(), share_of_means * fastest);
}

double sample_spacing(const model::System& system, const Eigen::VectorXd& state) {
  return 0.2 / std::max({1.0, std::fabs(system.pace()), std::fabs(system.speed(state))});
}

IntegrationStatus follow(const model::System& system, Eigen::VectorXd& state, double duration, double tolerance,
                         MotionStatistics* statistics, std::vector<Eigen::VectorXd>* samples, const StopFlag* stop) {
  if (!system.smooth()) {
    EventLog log;
    return follow_events(system, state, duration, tolerance, log, statistics, samples, stop);
  }
  const IntegrationStatus status = kernels::with_source(system, [&]<class Source>(Source) {
    const kernels::SmoothRun<Source> run(system, 0.0, tolerance);
    if (!statistics && !samples) return run.advance(duration, state.data(), kernels::unobserved, stop);
    Stretch stretch(system, run.flow(), state, statistics, samples);
    const IntegrationStatus ended = run.advance(
        duration, state.data(), [&](double from, double to, auto&& at) { stretch.step(from, to, at); }, stop);
    stretch.finish(duration);
    return ended;
  });
  return is_set(stop) ? IntegrationStatus::failed : status;
}

namespace {

constexpr std::size_t most_angles = std::size_t{1} << 16;
constexpr std::size_t blocks = 16;

// The mean increment between values first and last, weighted by exp(-1 / (s (1 - s))), s from 0 to 1.
double weighted_mean(const AngleRecord& record, std::size_t first, std::size_t last) {
  const double count = static_cast<double>(last - first);
  double sum = 0.0, weights = 0.0;
  for (std::size_t k = first; k < last; ++k) {
    const double s = (static_cast<double>(k - first) + 0.5) / count;
    const double weight = std::exp(-1.0 / (s * (1.0 - s)));
    sum += weight * (record[k + 1] - record[k]);
    weights += weight;
  }
  return sum / (weights * record.spacing());
}

// Three standard errors of the plain mean, from the means of blocks.
double error_from_blocks(const AngleRecord& record) {
  const std::size_t steps = (record.size() - 1) / blocks;
  const double duration = static_cast<double>(steps) * record.spacing();
  double sum = 0.0, squares = 0.0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const double rate = (record[(b + 1) * steps] - record[b * steps]) / duration;
    sum += rate;
    squares += rate * rate;
  }
  const double mean = sum / blocks;
  const double variance = std::max(0.0, squares / blocks - mean * mean) * blocks / (blocks - 1);
  return 3.0 * std::sqrt(variance / blocks);
}

}  // namespace

void AngleRecord::add(double angle) {
  if (skip_ > 0) {
    --skip_;
    return;
  }
  angles_.push_back(angle);
  if (angles_.size() > most_angles) {  // an odd number of values, so the last one stays
    for (std::size_t k = 0; 2 * k < angles_.size(); ++k) angles_[k] = angles_[2 * k];
    angles_.resize(most_angles / 2 + 1);
    stride_ *= 2;
    spacing_ *= 2.0;
  }
  skip_ = stride_ - 1;
}

AngleRecord operator-(const AngleRecord& a, const AngleRecord& b) {
  AngleRecord difference = a;
  for (std::size_t k = 0; k < a.size(); ++k) difference.angles_[k] -= b.angles_[k];
  return difference;
}

MeanRate mean_rate(const AngleRecord& record, bool regular) {
  MeanRate result;
  if (record.size() < 2) return result;
  const std::size_t last = record.size() - 1;
  result.duration = record.duration();
  result.turned = record[last] - record[0];
  result.rate = result.turned / result.duration;
  // Too short for blocks: all that is known is that a turn may be missed.
  result.error = two_pi / result.duration;
  if (record.size() <= 4 * blocks) return result;
  if (!regular) {
    result.error = error_from_blocks(record);
    return result;
  }
  result.rate = weighted_mean(record, 0, last);
  // Means over parts differ from the whole's mean by more than that one's error. Several parts are used, as two may
  // agree by chance.
  result.error = 0.0;
  const std::size_t quarter = last / 4;
  for (const auto& [from, to] : {std::pair{std::size_t{0}, 2 * quarter},
                                 {2 * quarter, last},
                                 {quarter, 3 * quarter},
                                 {std::size_t{0}, 3 * quarter},
                                 {quarter, last}})
    result.error = std::max(result.error, 3.0 * std::fabs(weighted_mean(record, from, to) - result.rate));
  return result;
}

Drift drift_of(const MeanRate& mean, bool regular, double matters) {
  // Trajectories have errors of 1e-9 a unit of time, and are still coming closer to their motion.
  constexpr double noise = 1e-7;
  const double rate = std::fabs(mean.rate);
  // An angle that only comes and goes never gains a whole turn. A turn is a slip.
  const bool slipped = std::fabs(mean.turned) > two_pi;
  if (regular) {
    // Slips of regular motion add up. Without one, parts of a record that is short for a torus may agree by chance on a
    // rate: on table 2's rotor up to eight times the error over 1000 units, on table 3's eleven times over 2500; about
    // the error at most from 4000 on. Such a rate is measured for longer.
    constexpr double long_record = 8000.0;
    if (slipped || (rate > 10.0 * mean.error + noise && mean.duration >= long_record)) return Drift::some;
    return rate <= mean.error + noise ? Drift::none : Drift::unknown;
  }
  // Chaos also slips back. By chance its mean exceeds three standard errors of sixteen blocks once in 110 records, and
  // four once in 860 (Student's t with 15 degrees of freedom). What lies in between is measured for longer.
  if (slipped && rate > 4.0 / 3.0 * mean.error + noise) return Drift::some;
  const bool none = rate <= mean.error + noise || (!slipped && rate <= matters);
  return none && mean.error <= matters ? Drift::none : Drift::unknown;
}

}  // namespace equipoise
