// Shares from even samples, with their intervals: independent replicates of scrambled Sobol starts, and a jittered grid
// with two independent starts per cell.
#pragma once

#include <cstdint>
#include <span>

#include "equipoise/core/statistics/share.hpp"

namespace equipoise {

/// `counts[r]` of `totals[r]` starts of replicate r. Replicates are independent and alike; their totals differ by at
/// most one start. Student's t interval over the replicates' means, with one degree of freedom fewer than replicates.
///
/// Wilson's interval where fewer than fewest_for_spread starts have the outcome, or lack it. Scrambled points are at
/// worst about as good as random ones: the tests of statistics measure that. Owen's bound (SIAM J. Numer. Anal. 34
/// (1997) 1884) is far from what rare sets show.
///
/// The width is never zero. If all k replicates agree to the last start, the share may still lie between two multiples
/// of one start in `totals`. Its distance f from the common count then has f <= 1 - (1 - confidence)^(1/k) at the
/// stated confidence, since each replicate rounds up or down with chances f and 1 - f. That is the smallest half-width.
Share replicated_share(std::span<const std::uint64_t> counts, std::span<const std::uint64_t> totals,
                       double confidence = 0.95);

/// What became of pairs of starts, one pair per cell; both starts have the cell's weight.
struct PairedCounts {
  std::uint64_t count = 0, total = 0;         ///< starts with the outcome; all
  double counted = 0.0;                       ///< sum of weights of the starts with the outcome
  double weight = 0.0, weight_squared = 0.0;  ///< sums over all starts
  std::uint64_t split = 0;                    ///< cells in which one start has the outcome and the other lacks it
  double split_squared = 0.0;                 ///< sum of their squared weights
};

/// Weighted share. In a cell of weight w with independent starts y_1, y_2, w^2 (y_1 - y_2)^2 / 4 estimates the variance
/// of its mean without bias, and the sum over cells that of the whole (S. Haber, Math. Comp. 21 (1967) 388). Student's
/// t with `split` degrees of freedom, fewer than the 2 `split` of a sum of `split` rare terms.
///
/// Wilson's interval if `complete` is false (the cells are then a sample), if fewer than fewest_for_spread starts have
/// the outcome or lack it, or if fewer than 10 cells are split. It is too wide, if anything: a jittered grid's variance
/// never exceeds that of as many random starts.
Share stratified_share(const PairedCounts& counts, bool complete, double confidence = 0.95);

}  // namespace equipoise
