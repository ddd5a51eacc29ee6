// Finds the attractors that a study has at its final speed.
// This room: attractors, sensitivities, displacements, growth rates of one study; two studies compared.
#pragma once

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/results/commands/attractors_result.hpp"

namespace equipoise {

/// With this many starts, an attractor with a share above 1e-3 is missed with a probability below 1e-9.
inline constexpr std::uint64_t search_starts = 20736;

/// As for basin(); transients are gathered only if requested.
struct AttractorsOptions : BasinOptions {
  std::uint64_t starts = search_starts;  ///< to search with, whatever study.sampling.starts says
};

/// Finds, refines and names every attractor of the final speed: from random starts, starts with coincident balls, and
/// options.warm_start_states. Throws as basin() does.
AttractorsResult attractors(const Study& study, const AttractorsOptions& options = {});

}  // namespace equipoise
