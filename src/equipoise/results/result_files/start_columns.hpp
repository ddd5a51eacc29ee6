// What is kept of every start: one column of values each, the same in unfinished and in finished files.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "equipoise/results/columns/dataset.hpp"
#include "equipoise/results/columns/transient_figures.hpp"
#include "equipoise/results/types/fate.hpp"

namespace equipoise {

struct BasinFileHeader;

/// Consecutive starts, as they come from a run. Every array has `count` entries or, where stated, so many per start.
struct StartBatch {
  std::size_t count = 0;
  const double* phi = nullptr;  ///< initial ball angles, one per ball
  const Fate* fates = nullptr;
  const double* rotor = nullptr;    ///< with full_starts: x, y, x_dot, y_dot
  const double* phi_dot = nullptr;  ///< with full_starts: one per ball
  const double* psi = nullptr;      ///< of the caller's own starts
  const double* weight = nullptr;   ///< on a grid
  const TransientRow* rows = nullptr;
  const double* drawn = nullptr;  ///< with uncertain values: one each
};

namespace io {

struct StartColumn : StoredColumn {
  /// By place in the batch: start by start.
  std::function<double(const StartBatch&, std::size_t place)> value;
};

/// The columns of a file, in order. To keep something more of every start, add it there and in what reads it.
std::vector<StartColumn> start_columns(const BasinFileHeader& header);

/// The fate that a code stands for. False if the code is unknown.
bool fate_from(short code, signed char by, double time, Fate& fate);

/// Marks a figure that a start does not have.
extern const float missing_figure;

/// From values of a transient figure in a file to what they mean: a start that was lost has none, a settling time
/// without an end, or a time above a limit, is infinite. `lost` is empty before the first figure.
void restore_missing(const TransientFigure& figure, std::vector<double>& values, std::vector<bool>& lost);

}  // namespace io
}  // namespace equipoise
