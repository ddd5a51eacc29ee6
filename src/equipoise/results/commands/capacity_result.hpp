// How large a parameter may become before a balancer fails.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/running/run_info.hpp"
#include "equipoise/core/statistics/share.hpp"
#include "equipoise/results/commands/sweep_result.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// One ensemble of the search.
struct CapacityTrial {
  double value = 0.0;
  Share balanced, undecided;  ///< balanced: starts that meet the requirement (asked()); no starts if `unstable`
  bool unstable = false;      ///< no balanced state attracts there: no start was followed
  /// States on the motions found, from which the search at a neighbouring value begins.
  std::vector<std::vector<double>> states;

  /// Upper bound on the balanced share, whatever undecided starts would come to.
  double most() const { return unstable ? 0.0 : balanced.most; }
};

/// The boundary in one cell: at every value tried below it, the balanced share is as large as required.
struct CapacityCell {
  std::vector<CapacityTrial> trials;  ///< by value
  /// Where the share falls short: half-way between the last value that does not and the first that does. Empty if it
  /// does so at the least value already, or nowhere.
  std::optional<double> value;
  /// With 95 % confidence at each end: the last value at which the share is certainly as large, however undecided
  /// starts would end, and the first at which it is certainly smaller. The ends of the range if there are none.
  double low = 0.0, high = 0.0;
  bool always = false;  ///< as large up to the end of the range: the capacity lies beyond
  bool never = false;   ///< smaller from the start of the range

  /// `low` and `high` as far as a trial shows them.
  std::optional<double> shown_low(double at_least) const {
    for (const CapacityTrial& t : trials)
      if (t.value <= low && !t.unstable && t.balanced.least >= at_least) return low;
    return std::nullopt;
  }
  std::optional<double> shown_high(double at_least) const {
    for (const CapacityTrial& t : trials)
      if (t.value >= high && t.most() < at_least) return high;
    return std::nullopt;
  }
};

/// What a stopped run knows of a cell's boundary, as CapacityCell::low and high; empty if no value tried shows it. More
/// trials only bring the two closer.
struct OpenCapacity {
  std::optional<double> low, high;
  std::size_t trials = 0;
};

struct CapacityRange {
  double from = 0.0, to = 0.0;  ///< from < to
  std::string unit = {};        ///< of quantities; empty for plain numbers
};

/// What is sought in every cell, within a range.
struct CapacityQuestion : CapacityRange {
  std::string key;              ///< as in --set
  double at_least = 0.95;       ///< share of starts that meet the requirement, in (0, 1)
  std::string by = "balanced";  ///< what a start must do: balance, meet all "limits", or meet one, by its name
  double precision = 0.005;     ///< of the boundary and its ends, relative to to - from
};

struct CapacityResult : RunInfo, CapacityQuestion {
  Study study;
  std::uint64_t starts = 0;  ///< of each ensemble
  std::vector<SweepAxis> axes;
  std::vector<std::optional<CapacityCell>> cells;  ///< as in a sweep
  std::vector<std::optional<OpenCapacity>> open;   ///< for cells that were begun and not finished
  std::uint64_t trials = 0;                        ///< made in this run
  std::uint64_t most_trials = 0;                   ///< number that all cells take
  std::uint64_t resumed_trials = 0;                ///< read from an earlier run's file

  /// "end balanced", "keep every limit", "keep limits.velocity".
  std::string asked() const {
    return by == "balanced" ? "end balanced" : by == "limits" ? "keep every limit" : "keep limits." + by;
  }
  /// The same of one start: "ends balanced", "keeps velocity".
  std::string asked_of_one() const { return by == "balanced" ? "ends balanced" : "keeps " + by; }
  bool complete() const {
    return std::all_of(cells.begin(), cells.end(), [](const auto& cell) { return !!cell; });
  }
};

}  // namespace equipoise
