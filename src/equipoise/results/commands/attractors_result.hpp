// The attractors of a study, with the shares of the starts that were searched.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/types/attractor.hpp"

namespace equipoise {

struct AttractorsResult {
  std::vector<Attractor> attractors;  ///< by identifier
  BasinResult basin;                  ///< shares of the starts that were searched
};

/// Probability with which a search of `starts` independent starts misses an attractor of this share.
inline double miss_probability(double share, std::uint64_t starts) {
  return std::exp(static_cast<double>(starts) * std::log1p(-share));
}

}  // namespace equipoise
