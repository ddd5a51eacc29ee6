// One cell of a sweep: an ensemble that begins its search where a neighbour's ended; ensembles of cells at the desk.
#pragma once

#include "equipoise/analyses/sweeps/survey.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/results/types/warm_start_levels.hpp"

namespace equipoise {

class Catalogue;
struct AttractorSearchCache;
struct BasinResult;
struct CellAtWork;

/// Blocks' cells one after another, each a record.
Survey sweep_survey(const SweepPlan& plan);

/// The ensemble at `at`, whatever way of sampling that names, at the desk while it is at work. `study`: what plan and
/// `at` say; `searches` and `found`: or null.
BasinResult cell_ensemble(const SweepPlan& plan, const CellAtWork& at, const Study& study, const BlockWorkers& workers,
                          AttractorSearchCache* searches, Catalogue& catalogue, WarmStartLevels* found);

}  // namespace equipoise
