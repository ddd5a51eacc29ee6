// A share from independent replicates of an even sample: the interval of scrambled Sobol starts.
#pragma once

#include <cstdint>
#include <span>

#include "equipoise/statistics/share.hpp"

namespace equipoise {

/// `counts[r]` of `totals[r]` starts of replicate r; replicates are independent and alike, and their totals differ by
/// one start at most. Student's t interval over the replicates' means, with one degree of freedom less than replicates.
///
/// Wilson's interval instead where fewer than fewest_for_spread starts have the outcome, or lack it: scrambled points
/// are at worst about as good as random ones (statistics tests measure that; Owen's bound, SIAM J. Numer. Anal. 34
/// (1997) 1884, is far from what rare sets show).
///
/// The width is never zero. If all k replicates agree to the last start, the share may still lie between two multiples
/// of one start in `totals`: its distance f from the common count has f <= 1 - (1 - confidence)^(1/k) at the stated
/// confidence, since each replicate rounds up or down with chances f and 1 - f. That is the smallest half-width.
Share replicated_share(std::span<const std::uint64_t> counts, std::span<const std::uint64_t> totals,
                       double confidence = 0.95);

}  // namespace equipoise
