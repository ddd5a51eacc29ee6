// Where something happens on a branch between two parameter values, and why.
#pragma once

#include <optional>
#include <vector>

#include "equipoise/analyses/continuation/branch_follower.hpp"
#include "equipoise/results/commands/branch.hpp"

namespace equipoise {

/// Why a branch ends where `end` stopped; unresolved if nothing shows it.
BranchCause cause_of_end(const BranchContinuation& follower, const Advance& end);

/// Changes of stability and kind between two neighbouring points of a branch, in order of value. Bisection brackets
/// them to 1/256 of the line's step for equilibria and periodic motions, to 1/16 for tori and chaos.
std::vector<BranchEvent> changes_between(const BranchContinuation& follower, const BranchPoint& low,
                                         const BranchPoint& high);

}  // namespace equipoise
