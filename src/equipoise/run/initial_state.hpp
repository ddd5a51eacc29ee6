// From a study's initial values to a state of the equations.
#pragma once

#include "equipoise/study/study.hpp"

namespace equipoise {

/// Writes dimension(balls) numbers: [initial] of `study` at rotor speed `speed` (psi' at t = 0), the balls at `phi`.
inline void initial_state(const Study& study, double speed, const double* phi, double* z) {
  const InitialState& s = study.initial;
  const int balls = study.parameters.balls;
  z[model::index::x] = s.x;
  z[model::index::y] = s.y;
  z[model::index::u] = s.x_dot - speed * s.y;
  z[model::index::v] = s.y_dot + speed * s.x;
  for (int i = 0; i < balls; ++i) {
    z[model::index::phi(i)] = phi[i];
    z[model::index::q(i, balls)] = s.phi_dot[i];
  }
}

}  // namespace equipoise
