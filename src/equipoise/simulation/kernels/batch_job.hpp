// A task with its rule and fates, and the compiled kernels, among which advance_batch() and classify_batch() choose
// (simulation/kernels/batch_kernels.hpp).
#pragma once

#include <vector>

#include "equipoise/results/types/fate.hpp"
#include "equipoise/simulation/batch/batch_task.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

struct BatchJob {
  const BatchTask& task;
  std::vector<Fate>& fates;
  const ClassificationRule* rule = nullptr;   ///< null: trajectories are taken to the task's end
  std::vector<PilotRecord>* pilot = nullptr;  ///< optional, with a rule
};

/// Rotors at a prescribed speed with a centred race, isotropic supports, no gravity, and balls that slide.
bool run_plain_batch(const BatchJob& job);
/// Rotors at a prescribed speed with a centred race.
bool run_general_batch(const BatchJob& job);
/// Every smooth system.
bool run_smooth_batch(const BatchJob& job);
/// Every system with contact or dry friction.
bool run_hybrid_batch(const BatchJob& job);
/// Every rotor that tilts.
bool run_tilting_batch(const BatchJob& job);
/// Driven rotors whose balls are held, to the task's end.
bool advance_held_batch(const BatchJob& job);
/// Driven rotors whose balls are held, until `rule` ends them.
bool run_clamped_batch(const BatchTask& task, const ReleaseRule& rule, std::vector<ClampedEnd>& ends);

}  // namespace equipoise
