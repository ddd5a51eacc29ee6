// What pictures of maps say beside their colours.
#pragma once

#include <string>

#include "equipoise/results/basin_slice.hpp"

namespace equipoise {

/// ", φ3 = π/2, φ4 = φ1 + π": the balls' angles that do not vary; nothing if all do.
std::string fixed_angles_text(const BasinSlice& map);

/// What the map lacks or leaves out; nothing if nothing.
std::string map_making_text(const BasinSlice& map);

}  // namespace equipoise
