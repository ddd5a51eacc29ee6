// A balanced state with the balls spread as a polygon in a circle.
#pragma once

#include <array>

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// Ball angles that cancel p.eccentricity: laid end to end, unbalance and balls in their order are the sides of a
/// polygon inscribed in a circle, which no other order of directions with these sides surpasses in area. Smooth in the
/// parameters up to where balance ends, with all balls in line. For rotors that do not tilt and have a balanced state.
std::array<double, max_balls> inscribed_polygon(const Parameters& p);

}  // namespace equipoise::model
