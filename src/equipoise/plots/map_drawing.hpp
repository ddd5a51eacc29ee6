// The picture on a basin slice's page, as SVG.
#pragma once

#include <string>

#include "equipoise/results/basin_slice.hpp"

namespace equipoise {

/// Outcomes by colour, listed below with their shares; lines where balance ends (dashed) or changes stability.
std::string map_svg(const BasinSlice& map);

/// "initial angle of ball 1, φ1" and so on, with units if the study has them.
std::string slice_axis_words(const Study& study, const SliceAxis& axis);

}  // namespace equipoise
