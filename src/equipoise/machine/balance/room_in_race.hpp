// Room in the race for colliding balls.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// Angle between balls side by side, in contact angles: clear of touching by more than rounding.
inline constexpr double side_by_side = 1.0 + 1e-6;

/// Maps uniformly drawn angles to angles without overlap, uniform among all such. The drawn gaps, shrunk to the room
/// that the balls leave, become the gaps beyond touching.
inline void make_room(const Parameters& p, double* phi) {
  const double room = (two_pi - p.balls * p.contact_angle) / two_pi;
  int place[max_balls];
  for (int i = 1; i < p.balls; ++i) {
    place[i] = 1;
    for (int j = 1; j < p.balls; ++j)
      if (wrapped_positive(phi[j] - phi[0]) < wrapped_positive(phi[i] - phi[0])) ++place[i];
  }
  for (int i = 1; i < p.balls; ++i)
    phi[i] = wrapped_positive(phi[0] + wrapped_positive(phi[i] - phi[0]) * room + place[i] * p.contact_angle);
}

/// The least angle between two balls, beyond that of touching; infinite for one ball.
inline double least_gap(const Parameters& p, const double* phi) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < i; ++k) least = std::min(least, std::fabs(wrapped(phi[i] - phi[k])));
  return least - p.contact_angle;
}

/// Whether colliding balls would overlap at these angles, by more than `rounding`.
inline bool overlap(const Parameters& p, const double* phi, double rounding = 0.0) {
  return p.balls_collide() && least_gap(p, phi) < -rounding;
}
/// Whether they do not. Touching balls, up to rounding, do not.
inline bool has_room(const Parameters& p, const double* phi) { return !overlap(p, phi, 1e-9); }

}  // namespace equipoise::model
