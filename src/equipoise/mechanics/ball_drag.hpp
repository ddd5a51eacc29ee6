// Drag of a ball in oil: Stokes (1851), with the wall correction of Haberman and Sayre (1958) for a ball on the axis of
// a tube, as in Happel and Brenner (1983), section 7-3. Only a first estimate for a race full of oil: the ball in a
// race runs along a wall, and both formulas hold only for creeping flow (Reynolds number below about 1).
#pragma once

#include "equipoise/base/angles.hpp"

namespace equipoise::model {

/// Drag force over velocity (N s/m) of a sphere of `diameter` (m) in unbounded liquid of `viscosity` (Pa s).
inline double stokes_drag(double viscosity, double diameter) { return 3.0 * pi * viscosity * diameter; }

/// The approximation below is within 6 % of the exact solution up to this ratio, and soon departs from it beyond.
inline constexpr double widest_ball_in_channel = 0.6;

/// Factor by which walls raise the drag. `ratio`: ball diameter over channel diameter, 0 to widest_ball_in_channel.
inline double wall_correction(double ratio) {
  const double a = ratio, a3 = a * a * a, a5 = a3 * a * a;
  return (1.0 - 0.75857 * a5) / (1.0 - 2.1050 * a + 2.0865 * a3 - 1.7068 * a5 + 0.72603 * a5 * a);
}

/// rho v d / eta.
inline double reynolds_number(double density, double velocity, double diameter, double viscosity) {
  return density * velocity * diameter / viscosity;
}

}  // namespace equipoise::model
