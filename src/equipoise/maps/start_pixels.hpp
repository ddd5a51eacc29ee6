// Maps over initial values: their pixels are starts of one system, and go together on lanes.
#pragma once

#include <vector>

#include "equipoise/base/run_options.hpp"
#include "equipoise/maps/map_pixel.hpp"
#include "equipoise/results/plane_map.hpp"

namespace equipoise {

/// Whether all pixels are starts of the same rotor: both axes are ball angles or, of balls that are free from the first,
/// other initial values.
bool maps_starts(const PlaneMap& map);

/// The pixels of such a map, row by row, decided as basin() decides its starts. Those not done when the stop flag was
/// set stay as they are. The study's horizon is filled in.
std::vector<MapPixel> start_pixels(const PlaneMap& map, const RunOptions& options);

}  // namespace equipoise
