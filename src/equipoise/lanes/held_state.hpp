// States of driven rotors whose balls are held, as lanes follow them: x, y, u, v; sum mu_i e^{i phi_i} of the balls,
// which stays; then what the system's state has of psi, psi' and the speed error.
#pragma once

#include <algorithm>
#include <complex>

#include "equipoise/model/system.hpp"
#include "equipoise/model/unbalance.hpp"

namespace equipoise {

inline int held_dimension(const model::System& system) {
  return model::dimension(1) + system.dimension() - model::dimension(system.balls());
}

/// From a state of the system to that with its balls held.
inline void hold_balls(const model::System& system, const double* state, double* held) {
  const model::Parameters& p = system.parameters();
  std::copy(state, state + 4, held);
  const double mass = p.total_mass();
  const std::complex<double> all = model::unbalance(p, state + model::index::phi(0));
  held[4] = all.real() - p.eccentricity - mass * p.race_offset[0];
  held[5] = all.imag() - mass * p.race_offset[1];
  std::copy(state + model::dimension(p.balls), state + system.dimension(), held + model::dimension(1));
}

/// Back again, the balls at rest; `state` holds their angles.
inline void release_balls(const model::System& system, const double* held, double* state) {
  const int balls = system.balls();
  std::copy(held, held + 4, state);
  std::fill_n(state + model::index::q(0, balls), balls, 0.0);
  std::copy(held + model::dimension(1), held + held_dimension(system), state + model::dimension(balls));
}

}  // namespace equipoise
