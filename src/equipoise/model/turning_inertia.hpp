// Rotor and balls turning as one body.
#pragma once

#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// About the axis, in M R^2: I_C is about the centre of mass, balls turn with the rotor.
inline double turning_inertia(const Parameters& p) {
  return p.inertia + p.eccentricity * p.eccentricity + p.total_mass();
}

}  // namespace equipoise::model
