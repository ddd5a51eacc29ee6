// The result of a sweep over parameters: one ensemble per cell.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/running/run_info.hpp"
#include "equipoise/results/commands/motion_table.hpp"
#include "equipoise/results/commands/outcome_share.hpp"
#include "equipoise/results/commands/transient_result.hpp"
#include "equipoise/results/types/warm_start_levels.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// One parameter and the values that it takes.
struct SweepParameter {
  std::string key;                 ///< as --set knows it; speed.final also where the speed is constant
  std::string unit;                ///< of quantities; empty for plain numbers
  std::vector<double> values;      ///< in that unit
  std::vector<std::string> given;  ///< the same as --set takes them
};

/// Parameters that vary together, one step at a time; a single one unless they are zipped.
struct SweepAxis {
  std::vector<SweepParameter> parameters;
  std::size_t size() const { return parameters.front().values.size(); }
};

/// An attractor in one cell.
struct SweepOutcome : OutcomeShare {  // id: the same for the same motion in all cells
  int own_id = 0;                     ///< the identifier that basin() gives it in this cell
  /// Of the motion: the centre's distance from the axis, period (0: none), mean ball rates; empty if only windows are
  /// known.
  std::optional<double> r_min{}, r_mean{}, r_max{};
  double period = 0.0;
  std::vector<double> drift{};
  std::vector<double> state{};  ///< a state on it; empty: unknown
};

/// A number that files and tables give for an outcome's motion in a cell; none if it has none.
struct MotionColumn : Column {
  std::optional<double> (*value)(const SweepOutcome&);
};
inline constexpr std::array<MotionColumn, 5> motion_columns{{
    {outcome_numbers.front(),
     [](const SweepOutcome& o) { return o.share.count > 0 ? std::optional(o.mean_time) : std::nullopt; }},
    {motion_number("r_min"), [](const SweepOutcome& o) { return o.r_min; }},
    {motion_number("r_mean"), [](const SweepOutcome& o) { return o.r_mean; }},
    {motion_number("r_max"), [](const SweepOutcome& o) { return o.r_max; }},
    {motion_number("period"),
     [](const SweepOutcome& o) { return o.period > 0.0 ? std::optional(o.period) : std::nullopt; }},
}};

struct SweepCell : OtherShares {
  std::uint64_t starts = 0;
  std::vector<SweepOutcome> outcomes;                ///< by own_id; balanced first
  std::optional<Share> passed;                       ///< of driven rotors
  std::shared_ptr<const TransientGroup> transients;  ///< of all starts, if gathered
  bool balanced_stable = false;
  std::string note;
  WarmStartLevels warm_start_levels;  ///< for the next cell's search, in addition to the motions
};

/// By index; consecutive cells follow the last axis; null: not done. Pointers: most cells of a large sweep are null.
using SweepCells = std::vector<std::shared_ptr<SweepCell>>;

struct SweepResult : RunInfo {
  Study study;  ///< the one that is varied
  std::vector<SweepAxis> axes;
  std::string identity;  ///< everything that determines the cells, as text
  SweepCells cells;
  double half_width = 0.0;  ///< requested; 0: none
  bool transients = false;
  std::uint64_t resumed_cells = 0;  ///< read from an earlier run's file

  bool complete() const {
    return std::all_of(cells.begin(), cells.end(), [](const auto& cell) { return !!cell; });
  }
};

/// Calls visit(index, cell) for every cell that is done.
template <class Cells, class Visit>
void visit_done(const Cells& cells, const Visit& visit) {
  for (std::size_t index = 0; index < cells.size(); ++index)
    if (cells[index]) visit(index, *cells[index]);
}

inline std::vector<std::size_t> place_on(const std::vector<SweepAxis>& axes, std::size_t cell) {
  std::vector<std::size_t> place(axes.size());
  for (std::size_t a = axes.size(); a-- > 0; cell /= axes[a].size()) place[a] = cell % axes[a].size();
  return place;
}
/// Calls visit(parameter, k) for every parameter: in this cell it has its k-th value.
template <class Visit>
void visit_parameters(const std::vector<SweepAxis>& axes, std::size_t cell, const Visit& visit) {
  const std::vector<std::size_t> place = place_on(axes, cell);
  for (std::size_t a = 0; a < axes.size(); ++a)
    for (const SweepParameter& p : axes[a].parameters) visit(p, place[a]);
}
/// Keys of everything that varies.
inline std::vector<std::string> keys_of(const std::vector<SweepAxis>& axes) {
  std::vector<std::string> keys;
  for (const SweepAxis& axis : axes)
    for (const SweepParameter& p : axis.parameters) keys.push_back(p.key);
  return keys;
}
/// "speed.final = 2.4, balancer.drag = 0.05".
inline std::string cell_title(const std::vector<SweepAxis>& axes, std::size_t cell) {
  std::string title;
  visit_parameters(axes, cell, [&](const SweepParameter& p, std::size_t k) {
    title += (title.empty() ? "" : ", ") + p.key + " = " + p.given[k];
  });
  return title;
}

}  // namespace equipoise
