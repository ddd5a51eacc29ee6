// Compares two samples: a computed share with a printed one, or one design with another on common starts.
#pragma once

#include <cstdint>
#include <vector>

#include "equipoise/core/statistics/share.hpp"

namespace equipoise {

/// A share known from print only.
struct PublishedShare {
  double share = 0.0;     ///< a fraction of one
  double rounding = 0.0;  ///< half a unit of the last printed digit
  std::uint64_t starts = 0;
};

/// Probability of a difference at least this large between two samples of one probability. Normal approximation with
/// pooled variance where both samples expect ten or more of each kind, else the exact test given the sum of the counts.
/// Of all values that round to the printed one, the nearest to ours is used.
double agreement_p_value(std::uint64_t count, std::uint64_t starts, const PublishedShare& published);

/// A difference of two shares, second minus first, with its interval.
struct ShareDifference {
  double difference = 0.0, low = -1.0, high = 1.0;
};

/// Difference between two independent samples: Newcombe's interval from two Wilson intervals (R. G. Newcombe, Statist.
/// Med. 17 (1998) 873, method 10).
ShareDifference independent_difference(const Share& first, const Share& second, double confidence = 0.95);

/// How often common starts ended as asked in one design, in both or in neither.
struct CommonStarts {
  std::uint64_t both = 0, first_only = 0, second_only = 0, neither = 0;
  std::uint64_t total() const { return both + first_only + second_only + neither; }
};
/// Compares start by start, up to the end of the shorter list.
CommonStarts compare_starts(const std::vector<bool>& first, const std::vector<bool>& second);

/// Difference between two designs on common starts: the adjusted Wald interval for paired shares (D. G. Bonett, R. M.
/// Price, J. Educ. Behav. Stat. 37 (2012) 479).
ShareDifference paired_difference(const CommonStarts& starts, double confidence = 0.95);

/// Means of two samples of a figure, and their difference, second minus first, with its interval.
struct MeanDifference {
  std::uint64_t first_count = 0, second_count = 0;  ///< finite values that it rests on; of pairs, those finite in both
  double first = 0.0, second = 0.0, difference = 0.0, low = 0.0, high = 0.0;  ///< infinite bounds: too few to say
};
/// Values of the same starts, pair by pair up to the end of the shorter list; Student's t over their differences.
MeanDifference paired_mean_difference(const std::vector<double>& first, const std::vector<double>& second,
                                      double confidence = 0.95);
/// Independent samples: Welch's interval (B. L. Welch, Biometrika 34 (1947) 28).
MeanDifference independent_mean_difference(const std::vector<double>& first, const std::vector<double>& second,
                                           double confidence = 0.95);

}  // namespace equipoise
