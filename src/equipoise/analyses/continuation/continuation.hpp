// Continues every attractor of a study along one of its parameters.
// This room: attractors along a parameter.
#pragma once

#include <cstdint>
#include <vector>

#include "equipoise/analyses/continuation/parameter_line.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/commands/branch.hpp"

namespace equipoise {

/// Random starts searched at a value. In one case in fifty they miss an attractor with a share of 0.2 %, and the pilot
/// has also searched for it.
inline constexpr std::uint64_t along_starts = 2000;

/// Progress counts values searched, then branches followed among those known so far.
struct ContinuationOptions : RunOptions {
  std::uint64_t starts = 0;  ///< random starts at every value in addition to the pilot's; 0: along_starts
  /// States tried at every value, each dimension(balls) numbers: ways to attractors too rare for the pilot.
  std::vector<std::vector<double>> warm_start_states;
};

/// Finds the attractors at every value of the line and half-way between. Follows each both ways as far as its motion
/// exists (or, for tori and chaos, attracts), locates events on the way, and gives each branch one identifier and name.
/// An end is a birth or a death only if its cause is known; otherwise the branch is first or last seen there. The
/// result has the values of the line, and those half-way at which a branch exists that has no others. A stopped search
/// returns what it has, marked partial. Deterministic.
BranchesResult follow_attractors(const Study& study, const ParameterLine& line,
                                 const ContinuationOptions& options = {});

}  // namespace equipoise
