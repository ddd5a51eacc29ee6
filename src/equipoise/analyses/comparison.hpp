// Two ensembles compared, start by start where their starts are the same.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/ensembles/basin.hpp"
#include "equipoise/result_files/basin_outcomes.hpp"
#include "equipoise/results/comparison_result.hpp"

namespace equipoise {

/// Throws InputError for studies whose starts cannot be decided, or lie on a grid: these have weights.
void check_comparable(const Study& study);

/// Runs basin() and keeps each start's outcome. Of `options` only those of a run count.
BasinOutcomes basin_outcomes(const Study& study, const RunOptions& options);

/// What read_basin_outcomes() or basin_outcomes() gave, of each study. Throws InputError for starts on a grid.
ComparisonResult compare(const BasinOutcomes& first, const BasinOutcomes& second);

}  // namespace equipoise
