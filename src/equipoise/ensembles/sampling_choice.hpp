// Which way of sampling reaches a half-width with the fewest starts: what a pilot says.
#pragma once

#include <cstdint>
#include <vector>

#include "equipoise/results/basin_result.hpp"
#include "equipoise/statistics/share.hpp"

namespace equipoise {

/// Starts of the pilot: 16 replicates of 1024 scrambled Sobol points.
inline constexpr std::uint64_t pilot_starts = 16384;

/// Random starts after which no interval of a share is wider than +- half_width, whatever the shares.
double most_random_starts(double half_width);
/// Random starts after which none of the intervals of these shares is.
double random_starts_for(const std::vector<Share>& shares, double half_width);

/// What a pilot's shares (every outcome met, one unmet) say of `half_width`. Sobol starts are taken to gain only as 1 /
/// sqrt(N) with their number, as random ones do, and the pilot's own count as taken: so the choice errs towards random.
SamplingChoice choose_sampling(const std::vector<Share>& pilot, double half_width);

}  // namespace equipoise
