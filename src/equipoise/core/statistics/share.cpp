// Wilson's score interval.
#include "equipoise/core/statistics/share.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/core/statistics/distributions.hpp"

namespace equipoise {

namespace {

// `n`: number of starts; fractional if they have weights.
void put_interval(Share& result, double n, double confidence) {
  const double z = normal_half_width(confidence), p = result.share;
  const double centre = (p + 0.5 * z * z / n) / (1.0 + z * z / n);
  const double half = z / (1.0 + z * z / n) * std::sqrt(p * (1.0 - p) / n + 0.25 * z * z / (n * n));
  result.low = result.count == 0 ? 0.0 : std::max(0.0, centre - half);
  result.high = result.count == result.total ? 1.0 : std::min(1.0, centre + half);
  result.least = result.low;
  result.most = result.high;
  result.standard_error = std::sqrt(p * (1.0 - p) / n);
  result.effective_starts = n;
}

}  // namespace

Share wilson_share(std::uint64_t count, std::uint64_t total, double confidence) {
  Share result{count, total};
  if (total == 0) return result;
  const double n = static_cast<double>(total);
  result.share = static_cast<double>(count) / n;
  put_interval(result, n, confidence);
  return result;
}

Share wilson_share(std::uint64_t count, std::uint64_t total, double counted, double weight, double weight_squared,
                   double confidence) {
  Share result{count, total};
  if (total == 0) return result;
  result.share = counted / weight;
  put_interval(result, weight * weight / weight_squared, confidence);
  return result;
}

Share open_share(std::uint64_t sure, std::uint64_t possible, std::uint64_t total, double confidence) {
  return share_between(wilson_share(sure, total, confidence), wilson_share(possible, total, confidence));
}

}  // namespace equipoise
