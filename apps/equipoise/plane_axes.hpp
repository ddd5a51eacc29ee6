// --x, --y and --size of the commands about a plane: map, stability, chart.
#pragma once

#include <string>

#include "equipoise/basin_slices/slice_axis.hpp"
#include "options.hpp"

namespace equipoise::app {

/// As typed: an axis is KEY=LOW:HIGH, or KEY with LOW:HIGH in its range.
struct PlaneAxes {
  std::string x, y, x_range, y_range, size;
};

/// Adds the options; what `axes` holds are their defaults. `x`, `y`, `size` are what a command's help says of them.
void add_plane_axes(CLI::App& app, PlaneAxes& axes, const char* x, const char* y, const char* size);

/// Throws InputError.
struct ReadAxes {
  SliceAxis x, y;
};
ReadAxes read_axes(const Study& study, const PlaneAxes& axes);

}  // namespace equipoise::app
