// What a test or a data sheet gives for supports and rotor, as the quantities of the equations.
#pragma once

#include "equipoise/core/base/standard_gravity.hpp"

#include <cmath>

#include "equipoise/core/base/angles.hpp"

namespace equipoise::model {

/// k = M omega^2, of the rotor alone. `frequency` in rad/s.
inline double stiffness_of_frequency(double mass, double frequency) { return mass * frequency * frequency; }
/// k = M g/sag.
inline double stiffness_of_sag(double mass, double gravity, double sag) { return mass * gravity / sag; }
/// Damping ratio of the free vibration whose amplitudes fall by a factor of e^decrement a cycle.
inline double ratio_of_decrement(double decrement) {
  return decrement / std::sqrt(4.0 * pi * pi + decrement * decrement);
}
/// Damping ratio at which the resonance of the velocity is as sharp as `quality`: Q = sqrt(k M)/c.
inline double ratio_of_quality(double quality) { return 0.5 / quality; }
/// A loss factor is 1/Q.
inline double ratio_of_loss(double loss) { return 0.5 * loss; }
/// e = G/omega (ISO 21940-11). `grade` in m/s, `speed` in rad/s.
inline double eccentricity_of_grade(double grade, double speed) { return grade / std::abs(speed); }
/// J = M r^2.
inline double inertia_of_gyration(double mass, double radius) { return mass * radius * radius; }
/// J = GD^2/4, of a mass times a diameter of gyration squared.
inline double inertia_of_gd2(double gd2) { return 0.25 * gd2; }

}  // namespace equipoise::model
