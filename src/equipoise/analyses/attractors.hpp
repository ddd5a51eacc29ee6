// Which steady motions a balancer has at its final speed.
#pragma once

#include "equipoise/ensembles/basin.hpp"
#include "equipoise/results/attractors_result.hpp"

namespace equipoise {

/// Starts after which an attractor with a share above 1e-3 has been missed with a probability below 1e-9.
inline constexpr std::uint64_t search_starts = 20736;

/// As for basin(); transients are gathered only if asked for.
struct AttractorsOptions : BasinOptions {
  std::uint64_t starts = search_starts;  ///< to search, whatever study.sampling.starts says
};

/// Every attractor of the study's final speed: found from random starts, from starts with coincident balls and from
/// options.seeds, refined, named. Throws as basin() does.
AttractorsResult attractors(const Study& study, const AttractorsOptions& options = {});

}  // namespace equipoise
