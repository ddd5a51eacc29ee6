// The result of an ensemble.
// This room: what commands return: shares, branches, slices, trajectories.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/running/run_info.hpp"
#include "equipoise/core/statistics/escape_rate.hpp"
#include "equipoise/core/statistics/share.hpp"
#include "equipoise/results/commands/outcome_share.hpp"
#include "equipoise/results/commands/sensitivity_result.hpp"
#include "equipoise/results/commands/start_arrays.hpp"
#include "equipoise/results/commands/transient_result.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/results/types/note.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {

/// How sampling was chosen to reach a half-width, where the study left it open.
struct SamplingChoice {
  SamplingMethod method = SamplingMethod::random;
  std::uint64_t pilot = 0;  ///< scrambled Sobol starts on which the choice rests; 0: none, because random starts need
                            ///< fewer than a pilot
  double random_starts = 0.0;  ///< needed for the half-width; without a pilot, for the worst of all shares
  double sobol_starts = 0.0;   ///< needed according to the pilot; 0 without one
};

/// Everything a report needs.
struct BasinResult : OtherShares, RunInfo {
  Study study;
  std::uint64_t starts = 0;              ///< counted: starts 0 to starts - 1
  std::uint64_t asked = 0;               ///< starts wanted; 0: as many as the half-width requires
  bool own_starts = false;               ///< starts are the caller's (BasinOptions::initial), not drawn
  bool partial = false;                  ///< stopped before all requested starts were done
  std::uint64_t resumed_from = 0;        ///< starts read from an earlier run's file
  std::vector<OutcomeShare> attractors;  ///< by identifier; balanced always comes first
  /// For a driven rotor: starts that turn faster than Study::passed_speed() in their motion or, if undecided, when last
  /// seen; and starts that came to something slower. Undecided starts that were slower when last seen may still come to
  /// either (least, most). Empty on a grid.
  std::optional<Share> passed, not_passed;
  /// For balls that collide: starts in which two touched before the outcome was known. All other starts would have gone
  /// the same way without collisions. Empty on a grid.
  std::optional<Share> met;
  /// How starts leave the chaos that some are still in at the horizon; times are dimensionless.
  std::optional<EscapeRate> chaos;
  std::optional<TransientResult> transients;  ///< if they were gathered
  /// With `transients`, unless stopped before it was known or not asked (BasinOptions::without_balls).
  std::optional<WithoutBalls> without_balls;
  std::optional<StartArrays> every_start;  ///< if they were kept
  /// With `every_start`: for each motion that the search before the first start had missed, the state in which a start
  /// first met it, as a file keeps it (with uncertain values: the start's number).
  std::vector<std::vector<double>> discoveries;
  std::optional<SensitivityResult> sensitivity;  ///< if it was requested
  double half_width = 0.0;                       ///< the one requested; 0: none
  std::optional<SamplingChoice> choice;          ///< if the method was left open
  std::optional<JitteredGrid> grid;              ///< for that method
  bool balanced_stable = false;                  ///< a linearly stable balanced state exists at the final speed
  Note note;                                     ///< why no start can end balanced, if that is so

  /// All attractors, and the other outcomes that some start came to (others_met()).
  std::vector<OutcomeShare> outcomes_met() const {
    std::vector<OutcomeShare> lines = attractors, others = others_met();
    lines.insert(lines.end(), others.begin(), others.end());
    return lines;
  }
};

}  // namespace equipoise
