// Two studies side by side: how much more often each outcome happens in the second.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/statistics/comparison.hpp"
#include "equipoise/statistics/share.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// One outcome, by name, in both studies.
struct ComparedShare {
  std::string name, alias;
  Share first, second;
  ShareDifference difference;  ///< second less first
};

/// Common starts that ended as `from` in the first study and as `to` in the second.
struct ChangedFate {
  std::string from, to;
  std::uint64_t starts = 0;
};

struct ComparisonResult {
  Study first, second;
  /// Whether start i began alike in both: same seed, method, balls and box. Differences are then of pairs, else of
  /// independent samples.
  bool common = false;
  std::string why_not_common;  ///< if so
  std::uint64_t starts = 0;    ///< compared: of common ones as many as both have
  std::vector<ComparedShare>
      shares;                    ///< as the first study lists them, then the second's own, undecided and its like last
  std::optional<Share> changed;  ///< of common starts, those that ended otherwise
  std::vector<ChangedFate> changes;     ///< the most frequent first
  std::optional<std::size_t> balanced;  ///< place of balance among `shares`
  /// Of its difference: bounds at 95 % whatever undecided starts would come to.
  double surely_low = -1.0, surely_high = 1.0;
  bool partial = false;
};

}  // namespace equipoise
