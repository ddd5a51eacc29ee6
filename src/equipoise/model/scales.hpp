// What one dimensionless unit is worth in a physical machine (docs/equations.md, "Units").
#pragma once

namespace equipoise::model {

/// The three units of a rotor: all others are made of them.
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
};

}  // namespace equipoise::model
