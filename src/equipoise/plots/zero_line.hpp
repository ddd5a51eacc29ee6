// Where a quantity known at a map's pixels changes its sign.
#pragma once

#include <array>
#include <vector>

#include "equipoise/results/basin_slice.hpp"

namespace equipoise {

using MapPoint = std::array<double, 2>;

/// Ends of the line pieces on which a field is zero, by linear interpolation along the edges of every cell between four
/// centres; pieces beside undefined values are left out. None where it is the same everywhere.
std::vector<std::array<MapPoint, 2>> zero_line(const BasinSlice& map, const std::vector<float>& values);

}  // namespace equipoise
