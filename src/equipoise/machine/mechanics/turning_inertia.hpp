// Moment of inertia of rotor and balls turning as one body.
#pragma once

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// About the axis, in M R^2; p.inertia is about the centre of mass.
inline double turning_inertia(const Parameters& p) {
  return p.inertia + p.eccentricity * p.eccentricity + p.total_mass();
}

}  // namespace equipoise::model
