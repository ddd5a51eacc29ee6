// Floating-point operations of the kernels, counted by running their own code on numbers that count.
#pragma once

#include <cstdint>

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::bench {

/// Operations of one evaluation of the right-hand side in one lane, constant speed. A fused multiply-add is two.
struct FlopCount {
  std::uint64_t flops = 0;
  std::uint64_t fused = 0;   ///< of these in fused multiply-adds, each counted as two
  std::uint64_t divide = 0;  ///< divisions and roots, each counted as one
};
FlopCount count_right_hand_side(const model::Parameters& p);

/// Operations of one step tried, all in: stages, solution, error, step control and 12 evaluations. Counted over a whole
/// trajectory of the lane block from `state` to `end` at constant speed (two balls); `state` becomes its final state.
double count_step(const model::Parameters& p, double speed, double* state, double end);

}  // namespace equipoise::bench
