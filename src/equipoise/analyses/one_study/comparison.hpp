// Compares two ensembles, start by start if they have the same starts.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/results/commands/comparison_result.hpp"
#include "equipoise/results/result_files/basin_outcomes.hpp"

namespace equipoise {

/// Throws InputError if starts cannot be decided, or lie on a grid: those have weights.
void check_comparable(const Study& study);

/// Runs basin() and keeps each start's outcome, and its transients as BasinOptions::transients has it.
BasinOutcomes basin_outcomes(const Study& study, const RunOptions& options,
                             std::optional<bool> transients = std::nullopt);

/// Takes results of read_basin_outcomes() or basin_outcomes(). Throws InputError for starts on a grid.
ComparisonResult compare(const BasinOutcomes& first, const BasinOutcomes& second);

}  // namespace equipoise
