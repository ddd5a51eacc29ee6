// The rotor that most tests start from, as parameters.
#pragma once

#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// lambda = 0.01, zeta = 0.5, equal balls: base_study.hpp, with any number of them.
inline model::Parameters base_rotor(int balls = 2, double drag = 0.05, double mass = 0.05) {
  model::Parameters p;
  p.balls = balls;
  p.mass.fill(mass);
  p.drag.fill(drag);
  return p;
}

}  // namespace equipoise
