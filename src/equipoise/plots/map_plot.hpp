// A picture of a basin slice, as a gnuplot script that contains the data.
#pragma once

#include <string>

#include "equipoise/results/basin_slice.hpp"

namespace equipoise {

enum class SliceShading { none, decision_time };

/// Draws the outcomes of `map` into `path` (.png or .svg), with names and shares beside it. An identifier has the same
/// colour in all pictures; with shading, pixels decided later are darker. Lines show where balance ceases to exist
/// (dashed) or changes stability (solid). Of more than 1600 pixels along a side some rows and columns are left out, and
/// the picture says so. `title` goes before the parameters.
std::string map_plot_script(const BasinSlice& map, const std::string& title, const std::string& path,
                            SliceShading shading = SliceShading::none);

}  // namespace equipoise
