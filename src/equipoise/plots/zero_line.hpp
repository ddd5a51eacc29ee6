// Where a quantity known at the pixels of a basin slice changes sign.
#pragma once

#include <array>
#include <vector>

#include "equipoise/results/basin_slice.hpp"

namespace equipoise {

using MapPoint = std::array<double, 2>;

/// Pieces of the line on which a field is zero, by linear interpolation along the edges of every cell between four
/// centres. Pieces beside undefined values are left out. Empty if the field is the same everywhere.
std::vector<std::array<MapPoint, 2>> zero_line(const BasinSlice& map, const std::vector<float>& values);
/// The same of values at the centres of the pixels of two axes, row by row.
std::vector<std::array<MapPoint, 2>> zero_line(const SliceAxis& x, const SliceAxis& y,
                                               const std::vector<float>& values);

}  // namespace equipoise
