// The compiled kernels that gather the statistics of transients, for every rotor. Chosen by advance_lanes() and
// decide_lanes() for tasks with a table; see run/lane_kernels.hpp.
#pragma once

#include <vector>

#include "equipoise/attractors/decision_rule.hpp"
#include "equipoise/attractors/fate.hpp"
#include "equipoise/ensemble/lane_task.hpp"

namespace equipoise {

/// advance_lanes() that adds to task.transients.
bool advance_transient_lanes(const LaneTask& task, std::vector<Fate>& fates);

/// decide_lanes() that adds to task.transients and follows trajectories on after their decision
/// (run/follow_on-inl.hpp); fates hold the time of decision.
bool decide_transient_lanes(const LaneTask& task, const DecisionRule& rule, std::vector<Fate>& fates);

}  // namespace equipoise
