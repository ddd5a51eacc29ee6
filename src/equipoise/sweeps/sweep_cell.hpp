// One cell of a sweep: an ensemble that begins its search where a neighbour's ended.
#pragma once

#include <cstddef>
#include <functional>

#include "equipoise/base/run_options.hpp"
#include "equipoise/results/sweep_result.hpp"
#include "equipoise/sweeps/sweep_plan.hpp"

namespace equipoise {

/// Computes the cells of a block one after another, those that are known already left out. `known`: a cell that was
/// done earlier, or null; `deliver`: takes each new one. False if stopped.
bool run_block(const SweepPlan& plan, std::size_t block, const std::function<const SweepCell*(std::size_t)>& known,
               const std::function<void(std::size_t, SweepCell)>& deliver, int threads, const StopFlag* stop);

}  // namespace equipoise
