// The compiled kernels: model, integrator, lane block and observer bound together, once per CPU target, chosen at run
// time.
// This room: batch, rule and watches compiled for every CPU target.
#pragma once

#include <vector>

#include "equipoise/results/types/outcome.hpp"
#include "equipoise/simulation/batch/batch_task.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// Takes every trajectory to task.end. False if stopped early.
/// `outcomes[i]` becomes diverged or failed for a trajectory lost on the way and is left alone otherwise; a lost one's
/// state stays where it was lost.
bool advance_batch(const BatchTask& task, std::vector<Outcome>& outcomes);

/// Decides every trajectory of a task over the last segment, or piece of a drive; outcomes[i] and states are set.
/// `pilot`, if given, receives one record per trajectory. False if stopped early.
bool classify_batch(const BatchTask& task, const ClassificationRule& rule, std::vector<Outcome>& outcomes,
                    std::vector<PilotRecord>* pilot);

/// Follows driven rotors whose balls are held (task.held) until they reach the release speed, are steady without
/// reaching it, or to task.end; ends[i] and states are set. False if stopped early.
bool follow_clamped_batch(const BatchTask& task, const ReleaseRule& rule, std::vector<ClampedEnd>& ends);

}  // namespace equipoise
