// Words in pictures of basin slices.
#pragma once

#include <string>

#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// ", φ3 = π/2, φ4 = φ1 + π": ball angles that do not vary; empty if all do.
std::string fixed_angles_text(const BasinSlice& map);

}  // namespace equipoise
