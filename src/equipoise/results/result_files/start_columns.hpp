// What is kept of every start: one column of values each, the same in unfinished and in finished files.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "equipoise/results/columns/dataset.hpp"
#include "equipoise/results/commands/start_arrays.hpp"
#include "equipoise/results/types/fate.hpp"

namespace equipoise {

struct BasinFileHeader;

namespace io {

struct StartColumn : StoredColumn {
  std::function<double(const StartArrays&, std::size_t place)> value;  ///< start by start
};

/// The columns of a file, in order. To keep something more of every start, add it there and in what reads it.
std::vector<StartColumn> start_columns(const BasinFileHeader& header);

/// The fate that a code stands for. False if the code is unknown.
bool fate_from(short code, signed char by, double time, Fate& fate);

/// Marks a figure that a start does not have: what NetCDF itself fills with.
inline constexpr float missing_figure = 9.9692099683868690e+36f;

/// From values of a transient figure in a file to what they mean: a start that was lost has none, a settling time
/// without an end, or a time above a limit, is infinite. `lost` is empty before the first figure.
void restore_missing(const TransientFigure& figure, std::vector<double>& values, std::vector<bool>& lost);

}  // namespace io
}  // namespace equipoise
