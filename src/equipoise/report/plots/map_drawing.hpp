// Pictures of a basin slice.
#pragma once

#include <string>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// Outcomes by colour, the darker, the later they were decided, listed below with their shares; lines where balance
/// ends (dashed) or changes stability. Of a large slice some rows and columns are left out, which the caption says.
DrawingRow map_drawing(const BasinSlice& map);

/// The same as a picture file (SVG); `title` goes before the parameters.
std::string map_plot(const BasinSlice& map, const std::string& title);

}  // namespace equipoise
