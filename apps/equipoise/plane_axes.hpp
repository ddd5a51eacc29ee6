// --x, --y and --size of the commands about a plane: map, stability, chart.
#pragma once

#include <string>

#include "equipoise/analyses/basin_slices/slice_axis.hpp"
#include "options.hpp"

namespace equipoise::app {

/// As typed: an axis is KEY=LOW:HIGH, or KEY with LOW:HIGH in its range.
struct PlaneAxes {
  std::string x, y, x_range, y_range, size;
};

/// Adds the options, whose defaults `axes` holds. `x`, `y`, `size` are what a command's help says of them.
void add_plane_axes(CLI::App& app, PlaneAxes& axes, const char* x, const char* y, const char* size);

struct ReadAxes {
  SliceAxis x, y;
};
/// Throws InputError.
ReadAxes read_axes(const Study& study, const PlaneAxes& axes);

/// What `compute` gives; an error about an axis or the size names its option, others of a plane what is `made`.
template <class Compute>
auto naming_axes(const ReadAxes& axes, const char* made, Compute compute) {
  try {
    return compute();
  } catch (const InputError& e) {
    throw under_names(e, axes.x, axes.y, {"--x", "--y", "--size", made});
  }
}

}  // namespace equipoise::app
