// What an ensemble answered.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/results/outcome_share.hpp"
#include "equipoise/results/sensitivity_result.hpp"
#include "equipoise/results/start_arrays.hpp"
#include "equipoise/results/transient_result.hpp"
#include "equipoise/sampling/sampling.hpp"
#include "equipoise/statistics/share.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

/// What sampling to a half-width chose where the study did not.
struct SamplingChoice {
  SamplingMethod method = SamplingMethod::random;
  std::uint64_t pilot = 0;  ///< scrambled Sobol starts that decided; 0: none, for random starts need fewer than a pilot
  double random_starts = 0.0;  ///< needed for the half-width; without a pilot for the worst of shares
  double sobol_starts = 0.0;   ///< needed, by the pilot; 0 without
};

/// Everything a report needs.
struct BasinResult : OtherShares {
  Study study;
  std::uint64_t starts = 0;              ///< counted: starts 0 to starts - 1
  std::uint64_t asked = 0;               ///< starts wanted; 0: as many as a half-width takes
  bool own_starts = false;               ///< the caller's (BasinOptions::initial), not drawn
  bool partial = false;                  ///< stopped before all requested starts were done
  std::uint64_t resumed_from = 0;        ///< starts read from an earlier run's file
  std::vector<OutcomeShare> attractors;  ///< by identifier; balanced is always the first
  /// Of a driven rotor: starts that turn faster than Study::passed_speed(), in the motion that they came to or,
  /// undecided, when last seen; and those that came to something slower. Undecided ones that were slower when last seen
  /// may come to either (least, most). Not of a grid.
  std::optional<Share> passed, not_passed;
  /// Of balls that collide: starts in which two touched before the fate was known. Had they passed through each other,
  /// all others would have gone the same way. Not of a grid.
  std::optional<Share> met;
  std::optional<TransientResult> transients;  ///< if they were gathered
  std::optional<StartArrays> every_start;     ///< if they were kept
  /// With `every_start`: of motions that the search before the first start had missed, the state in which a start first
  /// met each, as a file keeps it (with uncertain values: the start's number).
  std::vector<std::vector<double>> discoveries;
  std::optional<SensitivityResult> sensitivity;  ///< if it was asked for besides
  double half_width = 0.0;                       ///< asked for; 0: none
  std::optional<SamplingChoice> choice;          ///< if the method was left open
  std::optional<JitteredGrid> grid;              ///< for that method
  bool balanced_stable = false;                  ///< a linearly stable balanced state exists at the final speed
  std::string note;                              ///< why no start can end balanced, if so
  int threads = 0;
  std::string cpu_target;
  double seconds = 0.0, cpu_seconds = 0.0;  ///< of this run, discovery included

  /// All attractors, and of the others those that some start came to (others_met()).
  std::vector<OutcomeShare> outcomes_met() const {
    std::vector<OutcomeShare> lines = attractors, others = others_met();
    lines.insert(lines.end(), others.begin(), others.end());
    return lines;
  }
};

}  // namespace equipoise
