// What is to be made of a task's trajectories, and the compiled kernels that make it: chosen by advance_lanes() and
// decide_lanes(), see kernels/lane_kernels.hpp.
#pragma once

#include <vector>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/deciding/held.hpp"
#include "equipoise/lanes/lane_task.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

struct LaneJob {
  const LaneTask& task;
  std::vector<Fate>& fates;
  const DecisionRule* rule = nullptr;         ///< none: trajectories are taken to the task's end
  std::vector<PilotRecord>* pilot = nullptr;  ///< with a rule, if wanted
};

/// Of rotors at a prescribed speed, their race centred, for whose equations the rotor's angle is nothing (isotropic
/// supports, no gravity), with balls that slide.
bool run_plain_lanes(const LaneJob& job);
/// Of all such rotors.
bool run_general_lanes(const LaneJob& job);
/// Of every smooth system.
bool run_smooth_lanes(const LaneJob& job);
/// Of every system with contact or dry friction.
bool run_hybrid_lanes(const LaneJob& job);
/// Of rotors whose balls are held, to the task's end.
bool advance_held_lanes(const LaneJob& job);
/// Of driven rotors whose balls are held.
bool run_held_lanes(const LaneTask& task, const HoldRule& rule, std::vector<HeldEnd>& ends);

}  // namespace equipoise
