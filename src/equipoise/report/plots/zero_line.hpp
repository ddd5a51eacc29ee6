// Where a quantity known at the pixels of a basin slice changes sign.
#pragma once

#include <array>
#include <vector>

#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

using MapPoint = std::array<double, 2>;

/// Points along a line; the last is the first again if the line is closed.
using MapLine = std::vector<MapPoint>;

/// The lines on which a field is zero, by linear interpolation along the edges of every cell between four centres. They
/// break off next to undefined values. Empty if the field is the same everywhere.
std::vector<MapLine> zero_line(const BasinSlice& map, const std::vector<float>& values);
/// The same for values at the centres of the pixels of two axes, row by row.
std::vector<MapLine> zero_line(const SliceAxis& x, const SliceAxis& y, const std::vector<float>& values);

}  // namespace equipoise
