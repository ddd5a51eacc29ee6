// Balls side by side on the light side of the race.
#pragma once

#include <array>
#include <vector>

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// Ball angles of a fan: the heaviest ball in the middle and equal gaps, chosen so that the balls cancel p.eccentricity
/// to rounding. p.eccentricity must lie between what they cancel without gaps and with gaps all round. `width`: the
/// angle that each ball takes up.
std::array<double, max_balls> fan(const Parameters& p, const std::vector<double>& width);

}  // namespace equipoise::model
