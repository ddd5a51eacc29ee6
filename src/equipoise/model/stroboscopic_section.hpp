// Rotors whose equations at constant speed are periodic in the rotor's angle: anisotropic supports, gravity.
#pragma once

#include <array>
#include <cmath>

#include "equipoise/base/angles.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// Whether the equations in the rotating frame depend on psi.
inline bool depends_on_rotor_angle(const Parameters& p) { return !p.isotropic() || p.gravity != 0.0; }

/// Period of the equations in psi: half a turn for anisotropic supports, a whole turn with gravity.
inline double section_angle(const Parameters& p) { return p.gravity != 0.0 ? two_pi : pi; }

/// The same rotor with gravity and anisotropy scaled by `share`; the means of damping and stiffness stay.
inline Parameters weakened(Parameters p, double share) {
  for (auto* pair : {&p.damping, &p.stiffness}) {
    const double mean = 0.5 * ((*pair)[0] + (*pair)[1]), half = 0.5 * ((*pair)[0] - (*pair)[1]);
    *pair = {mean + share * half, mean - share * half};
  }
  p.gravity *= share;
  return p;
}

/// The time in which the rotor turns by section_angle() at constant `speed`, not 0.
inline double section_period(const Parameters& p, double speed) { return section_angle(p) / std::fabs(speed); }

/// Where the centre rests under the weight of rotor and balls: Y in fixed axes (X = 0). Zero without gravity.
inline double static_sag(const Parameters& p) {
  return p.gravity == 0.0 ? 0.0 : -(1.0 + p.total_mass()) * p.gravity / p.stiffness[1];
}

/// The same in the rotating frame, as (x, y), at rotor angle `psi`.
inline std::array<double, 2> rest_position(const Parameters& p, double psi) {
  if (p.gravity == 0.0) return {0.0, 0.0};
  return {static_sag(p) * std::sin(psi), static_sag(p) * std::cos(psi)};
}

}  // namespace equipoise::model
