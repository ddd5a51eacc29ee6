// A picture of a plane map, as a script for gnuplot with the data in it.
#pragma once

#include <string>

#include "equipoise/results/basin_slice.hpp"

namespace equipoise {

enum class SliceShading { none, decision_time };

/// Draws the outcomes of `map` into `path` (.png or .svg): one colour an identifier in all pictures, darker where it
/// was decided later if so shaded, names and shares beside it; where balance ends (dashed) and where it changes
/// stability (solid). Of more than 1600 pixels along a side some rows and columns are left out, and it says so. `title`
/// goes before the parameters.
std::string map_plot_script(const BasinSlice& map, const std::string& title, const std::string& path,
                            SliceShading shading = SliceShading::none);

}  // namespace equipoise
