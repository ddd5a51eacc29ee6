// Full turns and the shortest way between two angles.
#pragma once

#include <cmath>

namespace equipoise {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double two_pi = 6.28318530717958647692;

/// `angle` plus a whole number of turns, in [-pi, pi].
inline double wrapped(double angle) { return std::remainder(angle, two_pi); }

/// `angle` plus a whole number of turns, in [0, 2 pi].
inline double wrapped_positive(double angle) { return angle - two_pi * std::floor(angle / two_pi); }

}  // namespace equipoise
