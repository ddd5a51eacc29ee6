// Finds which uncertain values of a study decide whether a start ends balanced.
#pragma once

#include <cstdint>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/commands/sensitivity_result.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

inline constexpr std::uint64_t sensitivity_rows = 512;

/// Progress counts rows.
struct SensitivityOptions : RunOptions {
  std::uint64_t rows = sensitivity_rows;  ///< 2 or more; a row takes as many starts as there are uncertain values, and
                                          ///< 3 more
};

/// Throws InputError for a study without uncertain values, or one that basin() does not take.
void check_sensitivity(const Study& study);

/// First-order and total Sobol indices (core/statistics/sobol_indices.hpp) of the indicator "ends balanced", for every
/// uncertain value and for where the start begins. Row i uses starts 2 i and 2 i + 1 of the study's seed and mixtures
/// of them. They are random whatever its sampling.method, and depend on the study and i alone.
SensitivityResult sensitivity(const Study& study, const SensitivityOptions& options = {});

}  // namespace equipoise
