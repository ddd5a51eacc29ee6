// The compiled kernels for anisotropic supports and gravity, where the equations know the rotor's angle. Chosen by
// advance_lanes() and decide_lanes(); see run/lane_kernels.hpp.
#pragma once

#include <vector>

#include "equipoise/attractors/decision_rule.hpp"
#include "equipoise/attractors/fate.hpp"
#include "equipoise/ensemble/lane_task.hpp"

namespace equipoise {

/// advance_lanes() for every rotor.
bool advance_general_lanes(const LaneTask& task, std::vector<Fate>& fates);

/// decide_lanes() for every rotor.
bool decide_general_lanes(const LaneTask& task, const DecisionRule& rule, std::vector<Fate>& fates,
                          std::vector<PilotRecord>* pilot);

}  // namespace equipoise
