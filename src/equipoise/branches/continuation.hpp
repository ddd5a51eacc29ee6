// Every attractor of a study followed along one of its parameters.
#pragma once

#include <cstdint>
#include <vector>

#include "equipoise/base/run_options.hpp"
#include "equipoise/branches/parameter_line.hpp"
#include "equipoise/results/branches_result.hpp"

namespace equipoise {

/// Progress is in values searched first, then in branches followed of those known so far.
struct ContinuationOptions : RunOptions {
  std::uint64_t starts = 0;  ///< random starts searched at every value besides those of the pilot
  /// States tried at every value, each dimension(balls) numbers: ways to attractors too rare for the pilot.
  std::vector<std::vector<double>> seeds;
};

/// Finds the attractors at every value of the line, follows each both ways as far as its motion exists (or, for tori
/// and chaos, attracts), locates what happens on the way, and gives each branch one identifier and name. A stopped
/// search is returned as far as it came, marked partial. Deterministic.
BranchesResult follow_attractors(const Study& study, const ParameterLine& line,
                                 const ContinuationOptions& options = {});

}  // namespace equipoise
