// The compiled kernels that gather the statistics of transients, for every rotor. Chosen by advance_lanes() and
// decide_lanes() for tasks with a table; see kernels/lane_kernels.hpp.
#pragma once

#include <vector>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/deciding/fate.hpp"
#include "equipoise/lanes/lane_task.hpp"

namespace equipoise {

/// advance_lanes() that adds to task.transients.
bool advance_transient_lanes(const LaneTask& task, std::vector<Fate>& fates);

/// decide_lanes() that adds to task.transients and follows trajectories on after their decision
/// (deciding/follow_on-inl.hpp); fates hold the time of decision.
bool decide_transient_lanes(const LaneTask& task, const DecisionRule& rule, std::vector<Fate>& fates);

}  // namespace equipoise
