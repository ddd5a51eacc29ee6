// The attractors of a study, with the shares of the starts that were searched.
#pragma once

#include <cmath>
#include <cstdint>

#include "equipoise/motions/catalogue.hpp"
#include "equipoise/results/basin_result.hpp"

namespace equipoise {

struct AttractorsResult {
  Catalogue catalogue;
  BasinResult basin;  ///< shares of the starts that were searched
};

/// Probability with which a search of `starts` independent starts misses an attractor of this share.
inline double miss_probability(double share, std::uint64_t starts) {
  return std::exp(static_cast<double>(starts) * std::log1p(-share));
}

}  // namespace equipoise
