// Ball angles that cancel the eccentricity: side by side on the light side of the race, or spread round it.
#pragma once

#include <array>
#include <vector>

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// Ball angles of a fan: the heaviest ball in the middle and equal gaps, chosen so that the balls cancel p.eccentricity
/// to rounding. p.eccentricity must lie between what they cancel without gaps and with gaps all round. `width`: the
/// angle that each ball takes up.
std::array<double, max_balls> fan(const Parameters& p, const std::vector<double>& width);

/// Ball angles that cancel p.eccentricity: laid end to end, unbalance and balls in their order are the sides of a
/// polygon inscribed in a circle, which no other order of directions with these sides surpasses in area. Smooth in the
/// parameters up to where balance ends, with all balls in line. For rotors that do not tilt and have a balanced state.
std::array<double, max_balls> inscribed_polygon(const Parameters& p);

}  // namespace equipoise::model
