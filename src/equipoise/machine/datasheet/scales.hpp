// The physical units of a machine: one dimensionless unit of each quantity in SI (docs/explanation/equations.md,
// "Units").
#pragma once

#include <cmath>

namespace equipoise::model {

/// The three base units of a rotor, and the units derived from them.
struct Scales {
  double mass = 1.0;       ///< M in kg
  double length = 1.0;     ///< R in m
  double frequency = 1.0;  ///< omega_c in rad/s

  double time() const { return 1.0 / frequency; }                         ///< s
  double velocity() const { return length * frequency; }                  ///< m/s
  double acceleration() const { return length * frequency * frequency; }  ///< m/s^2
  double force() const { return mass * acceleration(); }                  ///< N
  double torque() const { return force() * length; }                      ///< N m, and energy in J
  double inertia() const { return mass * length * length; }               ///< kg m^2
  double gain() const { return inertia() * frequency; }                   ///< N m s: torque for a speed of rotation
  double stiffness() const { return mass * frequency * frequency; }       ///< N/m
  double damping() const { return mass * frequency; }                     ///< N s/m
  double unbalance() const { return mass * length; }                      ///< kg m

  /// For a rotor of `mass` (kg) and a race of `radius` (m). `stiffness` (N/m): mean of both directions.
  static Scales of(double mass, double radius, double stiffness) { return {mass, radius, std::sqrt(stiffness / mass)}; }
  /// Drag torque over rate (N m s) of a ball of `ball_mass` (kg) with beta = 1.
  double ball_drag(double ball_mass) const { return Scales{ball_mass, length, frequency}.gain(); }
};

}  // namespace equipoise::model
