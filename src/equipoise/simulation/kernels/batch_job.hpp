// A task with its rule and outcomes, and the compiled kernels, among which advance_batch() and classify_batch() choose
// (simulation/kernels/batch_kernels.hpp).
#pragma once

#include <vector>

#include "equipoise/results/types/outcome.hpp"
#include "equipoise/simulation/batch/batch_task.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

struct BatchJob {
  const BatchTask& task;
  std::vector<Outcome>& outcomes;
  const ClassificationRule* rule = nullptr;   ///< null: trajectories are taken to the task's end
  std::vector<PilotRecord>* pilot = nullptr;  ///< optional, with a rule
};

/// The kernel of a kind, compiled in a source of its own.
template <BatchKind kind>
bool run_kernel(const BatchJob& job);
template <>
bool run_kernel<BatchKind::plain>(const BatchJob& job);
template <>
bool run_kernel<BatchKind::turning>(const BatchJob& job);
template <>
bool run_kernel<BatchKind::smooth>(const BatchJob& job);
template <>
bool run_kernel<BatchKind::hybrid>(const BatchJob& job);
template <>
bool run_kernel<BatchKind::tilting>(const BatchJob& job);
/// Rotors whose balls are held, to the task's end.
bool advance_held_batch(const BatchJob& job);

}  // namespace equipoise
