// Every start of an ensemble in arrays: the content of basin()'s NetCDF file, without the file.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "equipoise/types/transient_table.hpp"

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
  std::vector<float> mean_speed;        ///< of a driven rotor; NaN if never measured
  std::vector<float> left_unbalance;    ///< of balls that stick; NaN where dry friction holds none
  std::vector<signed char> balls_met;   ///< of balls that touch: 1 if they did before the outcome was known
  /// If gathered: one array per column of transient_columns. Infinite (in files: missing) for a time without an end,
  /// NaN for starts that were lost.
  std::array<std::vector<float>, transient_columns.size()> transients;

  /// The column with this name, such as "settling_time"; null if there is none.
  const std::vector<float>* transient(std::string_view name) const {
    for (std::size_t k = 0; k < transient_columns.size(); ++k)
      if (name == transient_columns[k].name) return &transients[k];
    return nullptr;
  }
};

}  // namespace equipoise
