// States of driven rotors whose balls are held: x, y, u, v; the constant sum mu_i e^{i phi_i} of the balls; then psi,
// psi' and the speed error, as far as the system's state holds them.
#pragma once

#include <algorithm>
#include <complex>

#include "equipoise/machine/model/system.hpp"
#include "equipoise/machine/model/unbalance.hpp"

namespace equipoise::model {

inline StateLayout held_layout(const System& system) { return system.layout().with_balls(1); }

/// From a state of the system to its held state.
inline void hold_balls(const System& system, const double* state, double* held) {
  const Parameters& p = system.parameters();
  std::copy(state, state + 4, held);
  const double mass = p.total_mass();
  const std::complex<double> all = unbalance(p, state + index::phi(0));
  held[4] = all.real() - p.eccentricity - mass * p.race_offset[0];
  held[5] = all.imag() - mass * p.race_offset[1];
  copy_drive(system.layout(), state, held_layout(system), held);
}

/// The reverse, with the balls at rest; `state` already holds their angles.
inline void release_balls(const System& system, const double* held, double* state) {
  const int balls = system.balls();
  std::copy(held, held + 4, state);
  std::fill_n(state + index::q(0, balls), balls, 0.0);
  copy_drive(held_layout(system), held, system.layout(), state);
}

}  // namespace equipoise::model
