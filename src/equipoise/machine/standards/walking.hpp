// Whether a machine on feet slides on its floor.
#pragma once

#include <cmath>

#include "equipoise/core/base/standard_gravity.hpp"

namespace equipoise::standards {

/// The largest rotating force (N) under which a machine of this mass (kg) cannot slide, with coefficient `friction`
/// between feet and floor, where the force turns in a vertical plane: it pushes sideways and lifts in turn, and F cos a
/// > friction (m g - F sin a) for some angle beyond friction m g/sqrt(1 + friction^2). A machine may twist on its feet
/// under less (E. Papadopoulos, I. Papadimitriou, Proc. IEEE/ASME AIM 2001, 899).
inline double sliding_force(double mass, double friction) {
  return friction * mass * standard_gravity / std::sqrt(1.0 + friction * friction);
}

}  // namespace equipoise::standards
