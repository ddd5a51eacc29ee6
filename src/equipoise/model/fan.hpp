// Balls side by side on the light side of the race.
#pragma once

#include <array>
#include <vector>

#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// Ball angles in a fan, the heaviest in the middle, with equal gaps between them such that they cancel p.eccentricity
/// to rounding, which must lie between what they cancel with no gaps and with gaps all round. `width`: the angle that
/// each ball takes.
std::array<double, max_balls> fan(const Parameters& p, const std::vector<double>& width);

}  // namespace equipoise::model
