// How the balanced outcome of a study with uncertain values depends on them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/core/statistics/share.hpp"
#include "equipoise/core/statistics/sobol_indices.hpp"

namespace equipoise {

/// The key for the start itself among uncertain values: the ball angles, and what a box draws.
inline constexpr const char* start_input = "start";

struct InputSensitivity {
  std::string key;  ///< of an uncertain value, or start_input
  SobolIndices indices;
};

struct SensitivityResult {
  std::uint64_t rows = 0;         ///< pairs of independent starts
  std::uint64_t evaluations = 0;  ///< starts followed
  std::uint64_t undecided = 0;    ///< of these; counted as not balanced, like lost ones
  Share balanced;                 ///< of the pairs
  bool partial = false;           ///< stopped before all rows were done
  /// The largest total index first; empty if all starts balanced, or none.
  std::vector<InputSensitivity> inputs;
};

}  // namespace equipoise
