// Starts of a cell that is at work elsewhere.
#pragma once

#include "equipoise/basins/basin.hpp"
#include "equipoise/basins/ensemble_runner.hpp"
#include "equipoise/sweeps/cell_desk.hpp"
#include "equipoise/sweeps/sweep_plan.hpp"

namespace equipoise {

/// What is asked of a cell's ensemble, whoever works on it; for as long as `start` is there.
BasinOptions cell_options(const SweepPlan& plan, const CellStart& start);

/// The starts of a cell that another process works on. It searches as that one does, from where that began, and so
/// finds the same. Ask stopped() of it.
EnsembleHelper helper_for(const SweepPlan& plan, const CellAtWork& at, int threads, const StopFlag* stop);

}  // namespace equipoise
