// A record of displacement: the largest and the last r^2 of every trajectory in windows of time.
#pragma once

#include <array>
#include <cstddef>

namespace equipoise {

/// Two tables of count x windows numbers, row-major. Window k is [k width, (k + 1) width]. Tasks over successive
/// segments of one motion may share them: a window's largest r^2 only grows, and a lost trajectory's stays infinite.
struct RadiusWindows {
  double width = 0.0;       ///< > 0
  std::size_t windows = 0;  ///< per trajectory; later ones are not recorded
  float* largest = nullptr;
  float* at_end = nullptr;
  /// Of a rotor that tilts: where its slopes stand in the state, and the places along its shaft of which the farther
  /// one counts.
  int tilt = -1;
  std::array<double, 2> places{};
};

}  // namespace equipoise
