// Student's t over replicates, Haber's variance from pairs, Wilson for rare outcomes.
#include "equipoise/core/statistics/even_share.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "equipoise/core/statistics/distributions.hpp"

namespace equipoise {

namespace {

// A variance estimated from ten terms is good to about 1/sqrt(10) = 32 %, which Student's t allows for.
constexpr std::uint64_t fewest_split = 10;

Share with_spread(Share result, IntervalBy by, double half, double standard_error) {
  const double p = result.share;
  result.least = result.low = std::max(0.0, p - half);
  result.most = result.high = std::min(1.0, p + half);
  result.by = by;
  result.standard_error = standard_error;
  result.effective_starts = p * (1.0 - p) / (standard_error * standard_error);
  return result;
}

}  // namespace

Share replicated_share(std::span<const std::uint64_t> counts, std::span<const std::uint64_t> totals,
                       double confidence) {
  const std::uint64_t count = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  const std::uint64_t total = std::accumulate(totals.begin(), totals.end(), std::uint64_t{0});
  Share result = wilson_share(count, total, confidence);
  if (std::min(count, total - count) < fewest_for_spread) return result;
  const double replicates = static_cast<double>(counts.size()), p = result.share;
  double squares = 0.0;
  for (std::size_t r = 0; r < counts.size(); ++r) {
    const double deviation = static_cast<double>(counts[r]) / static_cast<double>(totals[r]) - p;
    squares += deviation * deviation;
  }
  const double t = students_t_half_width(replicates - 1.0, confidence);
  const double least = (1.0 - std::pow(1.0 - confidence, 1.0 / replicates)) * replicates / static_cast<double>(total);
  const double half = std::max(t * std::sqrt(squares / (replicates * (replicates - 1.0))), least);
  return with_spread(result, IntervalBy::replicates, half, half / t);
}

Share stratified_share(const PairedCounts& counts, bool complete, double confidence) {
  Share result =
      wilson_share(counts.count, counts.total, counts.counted, counts.weight, counts.weight_squared, confidence);
  const bool rare = std::min(counts.count, counts.total - counts.count) < fewest_for_spread;
  if (!complete || rare || counts.split < fewest_split) return result;
  // The sum of weights over starts is twice the sum over cells.
  const double error = std::sqrt(counts.split_squared) / counts.weight;
  const double half = error * students_t_half_width(static_cast<double>(counts.split), confidence);
  return with_spread(result, IntervalBy::pairs, half, error);
}

}  // namespace equipoise
