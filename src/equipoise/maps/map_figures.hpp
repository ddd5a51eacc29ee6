// Dimension, uncertainty and entropy of the basins in a map.
#pragma once

#include "equipoise/results/map_figures.hpp"
#include "equipoise/results/plane_map.hpp"

namespace equipoise {

/// Of a complete map. Undecided and failed pixels, and what the map did not come to, are no outcome: nothing is said of
/// them. Intervals of slopes are those of the straight line through the scales, of means those of boxes as if
/// independent.
MapFigures map_figures(const PlaneMap& map);

}  // namespace equipoise
