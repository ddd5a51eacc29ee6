// A share with its uncertainty.
#pragma once

#include <cstdint>

namespace equipoise {

/// Estimate of a probability from `count` of `total` independent starts, with a Wilson score interval (E. B. Wilson,
/// J. Am. Stat. Assoc. 22 (1927) 209). For zero counts the interval starts at 0 and its end is an upper bound.
struct Share {
  std::uint64_t count = 0, total = 0;
  double share = 0.0;  ///< count/total, a fraction of one (0 if total is 0)
  double low = 0.0, high = 1.0;

  double half_width() const { return 0.5 * (high - low); }
};

/// `confidence`: two-sided coverage, between 0 and 1. count <= total.
Share wilson_share(std::uint64_t count, std::uint64_t total, double confidence = 0.95);

}  // namespace equipoise
