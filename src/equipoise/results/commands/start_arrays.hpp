// Every start of an ensemble in arrays: the content of basin()'s NetCDF file, without the file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "equipoise/results/columns/transient_figures.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

/// Entry i of every array is start i. Arrays that do not apply to the study are empty.
struct StartArrays {
  std::uint64_t starts = 0;
  int balls = 0;
  std::vector<double> phi;              ///< initial ball angles, `balls` a start
  std::vector<double> psi;              ///< of the caller's own starts: initial psi
  std::vector<double> rotor_state;      ///< with a sampling box, or the caller's own: initial x, y, x_dot, y_dot, 4 per
                                        ///< start
  std::vector<double> phi_dot;          ///< with a sampling box, or the caller's own: `balls` per start
  std::vector<double> drawn;            ///< with uncertain values: the start's draw of each, in its own unit
  std::vector<double> weight;           ///< on a grid: cells that the start's cell stands for
  std::vector<short> outcome;           ///< attractor's identifier, or a code of no_attractors
  std::vector<double> decision_time;    ///< study time at which the outcome was known
  std::vector<signed char> decided_by;  ///< a DecidedBy
  std::vector<float> mean_speed;        ///< of a driven rotor; not-a-number where never measured
  std::vector<float> left_unbalance;    ///< of sticking balls; not-a-number where dry friction holds none
  std::vector<signed char> balls_met;   ///< of touching balls: 1 where they did before the outcome was known
  /// If they were gathered: one array a column of transient_figures. Infinite (a file says: missing) where a time goes
  /// on, not-a-number for starts that were lost.
  std::array<std::vector<float>, transient_figures.size()> transients;

  /// The column with this name, such as "settling_time"; null if there is none.
  const std::vector<float>* transient(std::string_view name) const {
    for (std::size_t k = 0; k < transient_figures.size(); ++k)
      if (name == transient_figures[k].name) return &transients[k];
    return nullptr;
  }
};

/// What became of a start; empty if its numbers are those of no outcome.
inline std::optional<Outcome> outcome_of(const StartArrays& starts, std::size_t i) {
  std::optional<Outcome> outcome = outcome_of(starts.outcome[i]);
  const signed char by = starts.decided_by[i];
  if (!outcome || by < 0 || by >= decided_by_count) return std::nullopt;
  outcome->by = static_cast<DecidedBy>(by);
  outcome->time = starts.decision_time[i];
  if (!starts.mean_speed.empty()) outcome->mean_speed = starts.mean_speed[i];
  if (!starts.left_unbalance.empty()) outcome->unbalance = starts.left_unbalance[i];
  if (!starts.balls_met.empty()) outcome->met = starts.balls_met[i] != 0;
  return outcome;
}

/// Its figures; not-a-number if they were not gathered.
inline TransientRow row_of(const StartArrays& starts, std::size_t i) {
  TransientRow row;
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    const std::vector<float>& values = starts.transients[k];
    row.*transient_figures[k].value = values.empty() ? std::numeric_limits<float>::quiet_NaN() : values[i];
  }
  return row;
}

}  // namespace equipoise
