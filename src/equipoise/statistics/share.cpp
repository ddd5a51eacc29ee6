// Wilson's score interval.
#include "equipoise/statistics/share.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/normal.hpp>

namespace equipoise {

Share wilson_share(std::uint64_t count, std::uint64_t total, double confidence) {
  Share result{count, total};
  if (total == 0) return result;
  const double z = boost::math::quantile(boost::math::normal(), 0.5 + 0.5 * confidence);
  const double n = static_cast<double>(total), p = static_cast<double>(count) / n;
  const double centre = (p + 0.5 * z * z / n) / (1.0 + z * z / n);
  const double half = z / (1.0 + z * z / n) * std::sqrt(p * (1.0 - p) / n + 0.25 * z * z / (n * n));
  result.share = p;
  result.low = count == 0 ? 0.0 : std::max(0.0, centre - half);
  result.high = count == total ? 1.0 : std::min(1.0, centre + half);
  return result;
}

}  // namespace equipoise
