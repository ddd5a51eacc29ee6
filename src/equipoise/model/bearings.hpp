// Bearings of a rotor that tilts, one by one.
#pragma once

#include <array>
#include <optional>

#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// Springs and dampers at one place along the shaft, in X and Y.
struct Bearing {
  std::array<double, 2> stiffness{}, damping{};
};

/// The bearings at these two places along the shaft, if they are all that holds the rotor: two springs at known places
/// follow from what they sum up to. Empty if stiffness or damping is not that of two bearings there.
std::optional<std::array<Bearing, 2>> two_bearings(const Parameters& p, const std::array<double, 2>& places);

}  // namespace equipoise::model
