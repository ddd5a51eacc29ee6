// Rotors whose equations at constant speed are periodic in the rotor's angle: anisotropic supports, gravity.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/bearings.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// Whether the equations in the rotating frame depend on psi.
inline bool depends_on_rotor_angle(const Parameters& p) { return !p.isotropic() || p.gravity != 0.0; }

/// Period of the equations in psi: half a turn for anisotropic supports, a whole turn with gravity.
inline double section_angle(const Parameters& p) { return p.gravity != 0.0 ? two_pi : pi; }

/// The same rotor with gravity and anisotropy scaled by `share`; the means of damping and stiffness stay.
inline Parameters weakened(Parameters p, double share) {
  const auto weaken = [&](double& x, double& y) {
    const double mean = 0.5 * (x + y), half = 0.5 * (x - y);
    x = mean + share * half;
    y = mean - share * half;
  };
  for (auto* pair : {&p.damping, &p.stiffness}) weaken((*pair)[0], (*pair)[1]);
  for (auto* pair : {&p.tilt.damping, &p.tilt.stiffness})
    for (const std::size_t k : {0, 1}) weaken((*pair)[0][k], (*pair)[1][k]);
  p.gravity *= share;
  return p;
}

/// The time in which the rotor turns by section_angle() at constant `speed`, not 0.
inline double section_period(const Parameters& p, double speed) { return section_angle(p) / std::fabs(speed); }

/// Centre and slope of a tilting rotor, along Y, under the weight of rotor and balls.
inline std::array<double, 2> static_tilt(const Parameters& p) {
  double moment = 0.0;
  for (int i = 0; i < p.balls; ++i) moment += p.mass[i] * p.tilt.plane[i];
  const double k11 = p.stiffness[1], k12 = p.tilt.stiffness[1][0], k22 = p.tilt.stiffness[1][1];
  const double force = -(1.0 + p.total_mass()) * p.gravity, determinant = k11 * k22 - k12 * k12;
  moment *= -p.gravity;
  return {(force * k22 - moment * k12) / determinant, (moment * k11 - force * k12) / determinant};
}

/// Where the centre rests under the weight of rotor and balls: Y in fixed axes (X = 0). Zero without gravity.
inline double static_sag(const Parameters& p) {
  if (p.gravity == 0.0) return 0.0;
  if (p.tilts()) return static_tilt(p)[0];
  return -(1.0 + p.total_mass()) * p.gravity / p.stiffness[1];
}

/// Of a tilting rotor: its slope there, along Y.
inline double static_slope(const Parameters& p) { return p.tilts() ? static_tilt(p)[1] : 0.0; }

/// Of rotor and balls.
inline double total_weight(const Parameters& p) { return (1.0 + p.total_mass()) * p.gravity; }
/// What a bearing of a tilting rotor takes of it at rest, along Y: negative where the shaft rests below the springs.
inline double load_at_rest(const Parameters& p, const Bearing& b) {
  return b.stiffness[1] * (static_sag(p) + b.at * static_slope(p));
}

/// The place of rest in the rotating frame, as (x, y), at rotor angle `psi`.
inline std::array<double, 2> rest_position(const Parameters& p, double psi) {
  if (p.gravity == 0.0) return {0.0, 0.0};
  return {static_sag(p) * std::sin(psi), static_sag(p) * std::cos(psi)};
}

}  // namespace equipoise::model
