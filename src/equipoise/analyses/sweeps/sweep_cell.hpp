// One cell of a sweep: an ensemble that begins its search where a neighbour's ended.
#pragma once

#include <vector>

#include "equipoise/analyses/sweeps/survey.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/results/types/warm_start_levels.hpp"

namespace equipoise {

class Catalogue;
struct AttractorSearchCache;
struct BasinResult;

/// Where a cell's search begins: with its neighbour's results.
struct CellStart {
  std::vector<std::vector<double>> warm_start_states;
  bool warm_start = false;
  WarmStartLevels warm_start_levels;
};

/// Blocks' cells one after another, each a record.
Survey sweep_survey(const SweepPlan& plan);

/// The ensemble of a cell with this study. `searches` and `found`: or null.
BasinResult cell_ensemble(const SweepPlan& plan, const CellStart& start, const Study& study,
                          const BlockWorkers& workers, AttractorSearchCache* searches, Catalogue& catalogue,
                          WarmStartLevels* found);

}  // namespace equipoise
