// Haber's variance from pairs, Wilson for rare outcomes.
#include "equipoise/statistics/stratified_share.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/statistics/distributions.hpp"

namespace equipoise {

namespace {
// An estimate of variance from so many terms is good to about 1/sqrt(10) = 32 %, which Student's t allows for.
constexpr std::uint64_t fewest_split = 10;
}  // namespace

Share stratified_share(const PairedCounts& counts, bool complete, double confidence) {
  Share result =
      wilson_share(counts.count, counts.total, counts.counted, counts.weight, counts.weight_squared, confidence);
  const bool rare = std::min(counts.count, counts.total - counts.count) < fewest_for_spread;
  if (!complete || rare || counts.split < fewest_split) return result;
  // The sum of weights over starts is twice that over cells.
  const double p = result.share;
  result.standard_error = std::sqrt(counts.split_squared) / counts.weight;
  const double half = result.standard_error * students_t_half_width(static_cast<double>(counts.split), confidence);
  result.least = result.low = std::max(0.0, p - half);
  result.most = result.high = std::min(1.0, p + half);
  result.by = IntervalBy::pairs;
  result.effective_starts = p * (1.0 - p) / (result.standard_error * result.standard_error);
  return result;
}

}  // namespace equipoise
