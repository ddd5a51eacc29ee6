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

/// One side of a comparison: a study, or the file of an ensemble.
struct ComparedSide {
  std::optional<Study> study;
  std::optional<BasinOutcomes> stored;

  /// As check_comparable().
  explicit ComparedSide(const Study& given);
  /// As read_basin_outcomes().
  explicit ComparedSide(const std::string& path);
};

/// Runs the sides that are studies. `transients`: whether they are gathered; unset: if either side has limits or
/// transients.
ComparisonResult compare(const ComparedSide& first, const ComparedSide& second, const RunOptions& of_first,
                         const RunOptions& of_second, std::optional<bool> transients);

/// Takes results of read_basin_outcomes() or basin_outcomes(). Throws InputError for starts on a grid.
ComparisonResult compare(const BasinOutcomes& first, const BasinOutcomes& second);

}  // namespace equipoise
