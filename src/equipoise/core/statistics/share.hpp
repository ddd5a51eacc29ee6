// A share with its uncertainty.
// This room: shares and their intervals, quantiles, the comparison of two samples.
#pragma once

#include <array>
#include <cstdint>

namespace equipoise {

/// A number with its 95 % interval.
struct Estimate {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// Where an interval comes from.
enum class IntervalBy {
  wilson,      ///< the binomial law
  replicates,  ///< the spread of independent replicates (even_share.hpp)
  pairs,       ///< differences within pairs of starts in one cell (even_share.hpp)
};

inline constexpr std::array<const char*, 3> interval_names{"wilson", "replicates", "pairs"};

/// A probability estimated from `count` of `total` starts, with its interval; for zero counts an upper bound.
struct Share {
  std::uint64_t count = 0, total = 0;
  double share = 0.0;  ///< count/total, or the weighted mean where starts have weights; 0 if total is 0
  double low = 0.0, high = 1.0;
  IntervalBy by = IntervalBy::wilson;
  double standard_error = 0.0;    ///< of `share`
  double effective_starts = 0.0;  ///< how many independent random starts have this standard error
  /// Bounds at the same confidence while it is open which starts count, valid in every case. Otherwise low and high.
  double least = 0.0, most = 1.0;

  double half_width() const { return 0.5 * (high - low); }
};

/// A share of independent starts with Wilson's score interval (E. B. Wilson, J. Am. Stat. Assoc. 22 (1927) 209).
/// `confidence`: two-sided coverage, between 0 and 1. count <= total.
Share wilson_share(std::uint64_t count, std::uint64_t total, double confidence = 0.95);

/// The same with weights: `weight` and `weight_squared` are sums over all starts, `counted` the sum of the weights of
/// those that count. Wilson's interval for Kish's number of starts, weight^2 / weight_squared.
Share wilson_share(std::uint64_t count, std::uint64_t total, double counted, double weight, double weight_squared,
                   double confidence = 0.95);

/// Of the starts that do not count.
inline Share complement(const Share& s) {
  Share other = s;
  other.count = s.total - s.count;
  other.share = 1.0 - s.share;
  other.low = 1.0 - s.high;
  other.high = 1.0 - s.low;
  other.least = 1.0 - s.most;
  other.most = 1.0 - s.least;
  return other;
}

/// A share in which further starts may turn out to count: `with_open` counts them all.
inline Share share_between(Share sure, const Share& with_open) {
  sure.most = with_open.high;
  return sure;
}

/// Wilson's interval if `sure` starts count and up to `possible` may; sure <= possible <= total.
Share open_share(std::uint64_t sure, std::uint64_t possible, std::uint64_t total, double confidence = 0.95);

/// Fewest starts with an outcome, and without it, for which the measured spread of an even sample gives the interval.
/// The skewness of a Poisson count of 80 is 1/9: a symmetric 95 % interval misses more often on one side, but hardly
/// more often overall. Even sampling gains little for rarer outcomes, and Wilson's interval is on the safe side.
inline constexpr std::uint64_t fewest_for_spread = 80;

}  // namespace equipoise
