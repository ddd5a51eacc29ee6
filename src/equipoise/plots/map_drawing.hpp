// The picture of a map's page, as SVG.
#pragma once

#include <string>

#include "equipoise/results/basin_slice.hpp"

namespace equipoise {

/// Outcomes by colour, named below with their shares; where balance ends to exist (dashed) and changes stability.
std::string map_svg(const BasinSlice& map);

/// "initial angle of ball 1, φ1" and its like, in units if the study has them.
std::string slice_axis_words(const Study& study, const SliceAxis& axis);

}  // namespace equipoise
