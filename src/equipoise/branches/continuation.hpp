// Every attractor of a study followed along one of its parameters.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/branches/parameter_line.hpp"
#include "equipoise/results/branches_result.hpp"

namespace equipoise {

/// How far the work has come: values searched first, then branches followed of those known so far.
struct ContinuationProgress {
  std::uint64_t done = 0, total = 0;
  const char* what = "";
};

struct ContinuationOptions {
  int threads = 0;           ///< 0: all cores. The result does not depend on it
  std::uint64_t starts = 0;  ///< random starts searched at every value besides those of the pilot
  /// States tried at every value, each dimension(balls) numbers: ways to attractors too rare for the pilot.
  std::vector<std::vector<double>> seeds;
  const StopFlag* stop = nullptr;
  std::function<void(const ContinuationProgress&)> progress;  ///< from any thread but never from two at once
};

/// Finds the attractors at every value of the line, follows each both ways as far as its motion exists (or, for tori
/// and chaos, attracts), locates what happens on the way, and gives each branch one identifier and name. A stopped
/// search is returned as far as it came, marked partial. Deterministic.
BranchesResult follow_attractors(const Study& study, const ParameterLine& line,
                                 const ContinuationOptions& options = {});

}  // namespace equipoise
