// Conversions of vectors and velocities between fixed axes and axes that turn with the rotor.
#pragma once

#include <array>

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// Components in fixed axes of the vector with components (x, y) in axes at rotor angle psi.
inline std::array<double, 2> in_fixed_axes(double cos_psi, double sin_psi, double x, double y) {
  return {x * cos_psi - y * sin_psi, x * sin_psi + y * cos_psi};
}

// The next three are as true of a tilt's four variables, sx, sy, us and vs.

/// (x', y') of a state z, which holds the inertial velocity, at psi' = w.
inline std::array<double, 2> rotating_velocity(double w, const double* z) {
  return {z[index::u] + w * z[index::y], z[index::v] - w * z[index::x]};
}

/// The inertial velocity (u, v), in rotating components, of (x', y') at (x, y).
inline std::array<double, 2> inertial_velocity(double w, double x, double y, double x_dot, double y_dot) {
  return {x_dot - w * y, y_dot + w * x};
}

/// psi' jumps by `jump` while position and velocity in the rotating frame (x, y, x', y') stay: u and v jump, and so do
/// the rates of a tilting rotor's slopes. `tilt`: the place of these slopes in the state; -1: the rotor stays upright.
inline void apply_speed_jump(double jump, double* z, int tilt = -1) {
  z[index::u] -= jump * z[index::y];
  z[index::v] += jump * z[index::x];
  if (tilt >= 0) apply_speed_jump(jump, z + tilt);
}

}  // namespace equipoise::model
