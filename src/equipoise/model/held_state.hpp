// States of driven rotors whose balls are held: x, y, u, v; the constant sum mu_i e^{i phi_i} of the balls; then psi,
// psi' and the speed error, as far as the system's state holds them.
#pragma once

#include <algorithm>
#include <complex>

#include "equipoise/model/system.hpp"
#include "equipoise/model/unbalance.hpp"

namespace equipoise::model {

/// Shift of the components after the balls, from the system's state to the held state.
inline int held_shift(const System& system) { return dimension(1) - dimension(system.balls()); }

inline int held_dimension(const System& system) { return system.dimension() + held_shift(system); }

inline DrivePlaces held_places(const System& system) {
  DrivePlaces places = system.places();
  for (int* place : {&places.psi, &places.speed, &places.error})
    if (*place >= 0) *place += held_shift(system);
  return places;
}

/// From a state of the system to its held state.
inline void hold_balls(const System& system, const double* state, double* held) {
  const Parameters& p = system.parameters();
  std::copy(state, state + 4, held);
  const double mass = p.total_mass();
  const std::complex<double> all = unbalance(p, state + index::phi(0));
  held[4] = all.real() - p.eccentricity - mass * p.race_offset[0];
  held[5] = all.imag() - mass * p.race_offset[1];
  std::copy(state + dimension(p.balls), state + system.dimension(), held + dimension(1));
}

/// The reverse, with the balls at rest; `state` already holds their angles.
inline void release_balls(const System& system, const double* held, double* state) {
  const int balls = system.balls();
  std::copy(held, held + 4, state);
  std::fill_n(state + index::q(0, balls), balls, 0.0);
  std::copy(held + dimension(1), held + held_dimension(system), state + dimension(balls));
}

}  // namespace equipoise::model
