// Exponential lifetimes: escapes are Poisson distributed.
#include "equipoise/core/statistics/escape_rate.hpp"

#include <numbers>

#include "equipoise/core/statistics/distributions.hpp"

namespace equipoise {

EscapeRate escape_rate(std::uint64_t escapes, std::uint64_t trajectories, double watched, double confidence) {
  const double count = static_cast<double>(escapes), outside = 0.5 * (1.0 - confidence);
  EscapeRate r{escapes, trajectories, watched};
  r.rate = count / watched;
  r.low = escapes == 0 ? 0.0 : gamma_quantile(count, outside) / watched;
  r.high = gamma_quantile(count + 1.0, 1.0 - outside) / watched;
  r.median = std::numbers::ln2 / r.rate;
  r.least = std::numbers::ln2 / r.high;
  r.most = std::numbers::ln2 / r.low;
  return r;
}

}  // namespace equipoise
