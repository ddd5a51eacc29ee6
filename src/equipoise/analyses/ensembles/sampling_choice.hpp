// Chooses from a pilot the sampling method that reaches a half-width with the fewest starts.
#pragma once

#include <cstdint>
#include <vector>

#include "equipoise/core/statistics/share.hpp"
#include "equipoise/results/commands/basin_result.hpp"

namespace equipoise {

/// Starts of the pilot: 16 replicates of 1024 scrambled Sobol points.
inline constexpr std::uint64_t pilot_starts = 16384;

/// Random starts after which every share's interval is within +- half_width, whatever the shares are.
double most_random_starts(double half_width);
/// The same for these shares.
double random_starts_for(const std::vector<Share>& shares, double half_width);

/// Chooses from a pilot's shares: every outcome met, and one not met. Sobol intervals are assumed to shrink only as 1 /
/// sqrt(N), as random ones do, so the choice errs towards random. The pilot counts as part of a Sobol sample.
SamplingChoice choose_sampling(const std::vector<Share>& pilot, double half_width);

}  // namespace equipoise
