// Bearings of a tilting rotor, one by one.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// The largest number of a rotor's bearings for which forces are reported.
inline constexpr std::size_t most_bearings = 8;

/// Springs and dampers at one place along the shaft, in X and Y.
struct Bearing {
  double at = 0.0;
  std::array<double, 2> stiffness{}, damping{};
};

/// Stiffness or damping of all supports in one direction, [k11, k12; k12, k22] of centre and slope.
struct SupportMatrix {
  double centre = 0.0, across = 0.0, tilt = 0.0;

  void add(double size, double at) {
    centre += size;
    across += size * at;
    tilt += size * at * at;
  }
  double determinant() const { return centre * tilt - across * across; }
  /// Supports at a single place, whose sums and moments are rounded, have a determinant of zero.
  double rounding() const { return 1e-12 * centre * tilt; }
};

/// The bearings at these two places along the shaft, if they are all that holds the rotor: two springs at known places
/// follow from what they sum up to. Empty if stiffness or damping is not that of two bearings there.
std::vector<Bearing> two_bearings(const Parameters& p, const std::array<double, 2>& places);

/// Whether springs (dampers) of all these bearings sum up to the rotor's supports; to 1e-6, as numbers are typed.
bool make_stiffness(const std::vector<Bearing>& bearings, const Parameters& p);
bool make_damping(const std::vector<Bearing>& bearings, const Parameters& p);

}  // namespace equipoise::model
