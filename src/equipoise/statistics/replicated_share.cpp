// Student's t over replicates, Wilson for rare outcomes.
#include "equipoise/statistics/replicated_share.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "equipoise/statistics/distributions.hpp"

namespace equipoise {

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
  result.least = result.low = std::max(0.0, p - half);
  result.most = result.high = std::min(1.0, p + half);
  result.by = IntervalBy::replicates;
  result.standard_error = half / t;
  result.effective_starts = p * (1.0 - p) / (result.standard_error * result.standard_error);
  return result;
}

}  // namespace equipoise
