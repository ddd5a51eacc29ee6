// How large a parameter may become before a balancer fails.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/results/sweep_result.hpp"
#include "equipoise/statistics/share.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// One ensemble on the way to it.
struct CapacityTrial {
  double value = 0.0;
  Share balanced, undecided;  ///< of no starts if `unstable`
  bool unstable = false;      ///< no balanced state attracts there: none of its starts were followed
  /// On the motions found, where the search at a neighbouring value begins.
  std::vector<std::vector<double>> states;

  /// What the balanced share is at most, whatever undecided starts would come to.
  double most() const { return unstable ? 0.0 : balanced.most; }
};

/// The boundary in one cell: below it the balanced share of the starts is as large as asked at every value tried.
struct CapacityCell {
  std::vector<CapacityTrial> trials;  ///< by value
  /// Where the share falls short, half-way between the last value that does not and the first that does; none where it
  /// does at the least value already, or nowhere.
  std::optional<double> value;
  /// With 95 % confidence at each end: the last value at which the share is surely as large, whatever undecided starts
  /// would come to, and the first at which it is surely smaller; the ends of the range where there are none.
  double low = 0.0, high = 0.0;
  bool always = false;  ///< as large up to the end of the range: the capacity is beyond it
  bool never = false;   ///< smaller from its begin on
};

/// What a stopped run knows of a cell's boundary, as CapacityCell::low and high: none where no value tried says so.
/// More trials only bring the two closer.
struct OpenCapacity {
  std::optional<double> low, high;
  std::size_t trials = 0;
};

struct CapacityResult {
  Study study;
  std::string key, unit;  ///< of what is asked for, and of its values
  double from = 0.0, to = 0.0, precision = 0.0;
  double at_least = 0.95;
  std::uint64_t starts = 0;  ///< of every ensemble
  std::vector<SweepAxis> axes;
  std::vector<std::optional<CapacityCell>> cells;  ///< as of a sweep
  std::vector<std::optional<OpenCapacity>> open;   ///< of cells that were begun and not done
  std::uint64_t trials = 0;                        ///< made in this run
  std::uint64_t most_trials = 0;                   ///< that all cells take
  std::uint64_t resumed_trials = 0;                ///< read from an earlier run's file
  int threads = 0;
  std::string cpu_target;
  double seconds = 0.0, cpu_seconds = 0.0;

  bool complete() const {
    for (const auto& cell : cells)
      if (!cell) return false;
    return true;
  }
};

}  // namespace equipoise
