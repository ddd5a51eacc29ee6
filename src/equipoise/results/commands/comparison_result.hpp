// Two studies side by side: how much more often each outcome happens in the second.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/statistics/comparison.hpp"
#include "equipoise/core/statistics/share.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// One outcome, by name, in both studies.
struct ComparedShare {
  std::string name, alias;
  Share first, second;
  ShareDifference difference;  ///< second less first
};

/// Starts that keep every limit of their own study, those lost left out as everywhere.
struct ComparedLimits {
  Share first, second;
  ShareDifference difference;                   ///< second less first
  double surely_low = -1.0, surely_high = 1.0;  ///< at 95 % whatever undecided starts would come to
  bool alike = true;                            ///< both studies state the same limits
};

/// Common starts that ended as `from` in the first study and as `to` in the second.
struct ChangedOutcome {
  std::string from, to;
  std::uint64_t starts = 0;
};

/// A figure of transients in both studies, in one unit; means are over starts whose figure has an end.
struct ComparedFigure {
  std::string name, title, unit;
  MeanDifference mean;                            ///< second less first
  std::uint64_t first_open = 0, second_open = 0;  ///< starts without an end: the motion at the end exceeds the limit
};

struct ComparisonResult {
  Study first, second;
  /// Whether start i began alike in both (same seed, method, balls and box): differences are then paired, else
  /// independent.
  bool common = false;
  std::string why_not_common;  ///< if not
  std::uint64_t starts = 0;    ///< starts compared: if common, as many as both have
  std::vector<ComparedShare>
      shares;                    ///< in the first study's order, then the second's own, outcomes without attractor last
  std::optional<Share> changed;  ///< of common starts, those with another outcome
  std::vector<ChangedOutcome> changes;  ///< the most frequent first
  std::optional<std::size_t> balanced;  ///< index of balance in `shares`
  /// For its difference: bounds at 95 % whatever undecided starts would come to.
  double surely_low = -1.0, surely_high = 1.0;
  std::optional<ComparedLimits> limits;  ///< if both studies state limits and have transients
  std::vector<ComparedFigure> figures;   ///< if both have transients, in units that both are shown in
  bool partial = false;
};

}  // namespace equipoise
