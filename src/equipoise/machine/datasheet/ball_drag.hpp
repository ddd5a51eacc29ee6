// Drag of a ball in oil: Stokes (1851), with the walls of Bungay and Brenner (1973) for a ball on the axis of a tube.
// Only a first estimate for a race full of oil: the ball in a race runs along a wall, the ring of oil may turn with the
// balls, and both formulas hold only for creeping flow (Reynolds number below about 1).
#pragma once

#include <cmath>

#include "equipoise/core/base/angles.hpp"

namespace equipoise::model {

/// Drag force over velocity (N s/m) of a sphere of `diameter` (m) in unbounded liquid of `viscosity` (Pa s).
inline double stokes_drag(double viscosity, double diameter) { return 3.0 * pi * viscosity * diameter; }

/// Up to this ratio the formula was compared with the exact solution. A closer ball moves the ring of oil
/// rather than let it through the gap, which no formula for a long tube knows.
inline constexpr double widest_ball_in_channel = 0.8;

/// Factor by which walls raise the drag. `ratio`: ball diameter over channel diameter, 0 to widest_ball_in_channel,
/// where it is within 0.2 % of the exact solution. Bungay and Brenner (1973): the film between ball and wall, expanded
/// in its width, and powers of the ratio that make it exact to first order for small balls.
inline double wall_correction(double ratio) {
  const double gap = 1.0 - ratio;
  const double film =
      2.25 * pi * pi * std::sqrt(2.0) * std::pow(gap, -2.5) * (1.0 - 73.0 / 60.0 * gap + 77293.0 / 50400.0 * gap * gap);
  const double rest = -22.5083 + ratio * (-5.6117 + ratio * (-0.3363 + ratio * (-1.216 + ratio * 1.647)));
  return (film + rest) / (6.0 * pi);
}

/// rho v d / eta.
inline double reynolds_number(double density, double velocity, double diameter, double viscosity) {
  return density * velocity * diameter / viscosity;
}

}  // namespace equipoise::model
