// A share from cells with two independent starts in each: the interval of a jittered grid.
#pragma once

#include <cstdint>

#include "equipoise/statistics/share.hpp"

namespace equipoise {

/// What became of pairs of starts, one pair a cell; both starts of a cell have its weight.
struct PairedCounts {
  std::uint64_t count = 0, total = 0;         ///< starts with the outcome; all
  double counted = 0.0;                       ///< sum of weights of the starts with the outcome
  double weight = 0.0, weight_squared = 0.0;  ///< sums over all starts
  std::uint64_t split = 0;                    ///< cells of which one start has the outcome and the other has not
  double split_squared = 0.0;                 ///< sum of their squared weights
};

/// Weighted share. In a cell of weight w with independent starts y_1, y_2, w^2 (y_1 - y_2)^2 / 4 estimates the variance
/// of its mean without bias, and the sum over cells that of the whole (S. Haber, Math. Comp. 21 (1967) 388). Student's
/// t with `split` degrees of freedom, fewer than the 2 `split` of a sum of so many rare terms.
///
/// Wilson's interval instead if `complete` is false (the cells are then a sample), or where fewer than
/// fewest_for_spread starts have the outcome or lack it, or fewer than 10 cells are split. It is too wide, if anything:
/// a jittered grid's variance is never above that of as many random starts.
Share stratified_share(const PairedCounts& counts, bool complete, double confidence = 0.95);

}  // namespace equipoise
