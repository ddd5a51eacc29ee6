// Room in the race for colliding balls.
#pragma once

#include <cmath>

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

/// Whether balls at these angles do not overlap. Touching balls, up to rounding, do not.
inline bool has_room(const Parameters& p, const double* phi) {
  constexpr double rounding = 1e-9;
  if (!p.balls_collide()) return true;
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < i; ++k)
      if (std::fabs(wrapped(phi[i] - phi[k])) < p.contact_angle - rounding) return false;
  return true;
}

}  // namespace equipoise::model
