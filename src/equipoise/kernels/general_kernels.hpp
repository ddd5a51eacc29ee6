// The compiled kernels for anisotropic supports and gravity, where the equations know the rotor's angle. Chosen by
// advance_lanes() and decide_lanes(); see kernels/lane_kernels.hpp.
#pragma once

#include <vector>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/deciding/fate.hpp"
#include "equipoise/lanes/lane_task.hpp"

namespace equipoise {

/// advance_lanes() for every rotor.
bool advance_general_lanes(const LaneTask& task, std::vector<Fate>& fates);

/// decide_lanes() for every rotor.
bool decide_general_lanes(const LaneTask& task, const DecisionRule& rule, std::vector<Fate>& fates,
                          std::vector<PilotRecord>* pilot);

}  // namespace equipoise
