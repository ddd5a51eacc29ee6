// Means of increments: smoothly weighted for regular motion, plain with errors from blocks for chaos.
#include "equipoise/attractors/motions/mean_rate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "equipoise/core/base/angles.hpp"

namespace equipoise {

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
