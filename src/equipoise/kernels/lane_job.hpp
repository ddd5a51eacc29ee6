// A task with its rule and fates, and the compiled kernels, among which advance_lanes() and decide_lanes() choose
// (kernels/lane_kernels.hpp).
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
  const DecisionRule* rule = nullptr;         ///< null: trajectories are taken to the task's end
  std::vector<PilotRecord>* pilot = nullptr;  ///< optional, with a rule
};

/// Rotors at a prescribed speed with a centred race, isotropic supports, no gravity, and balls that slide.
bool run_plain_lanes(const LaneJob& job);
/// Rotors at a prescribed speed with a centred race.
bool run_general_lanes(const LaneJob& job);
/// Every smooth system.
bool run_smooth_lanes(const LaneJob& job);
/// Every system with contact or dry friction.
bool run_hybrid_lanes(const LaneJob& job);
/// Driven rotors whose balls are held, to the task's end.
bool advance_held_lanes(const LaneJob& job);
/// Driven rotors whose balls are held, until `rule` ends them.
bool run_held_lanes(const LaneTask& task, const HoldRule& rule, std::vector<HeldEnd>& ends);

}  // namespace equipoise
