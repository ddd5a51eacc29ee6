// The same state of rotors that hang differently.
#pragma once

#include "equipoise/model/parameters.hpp"
#include "equipoise/model/strobe.hpp"

namespace equipoise::model {

/// Moves the centre in a state of one rotor, when it has turned by `psi`, to where that of another is, as far from where
/// that one rests. A soft rotor sags by more than it ever shakes.
inline void hang_anew(const Parameters& from, const Parameters& to, double psi, double* state) {
  const auto before = rest_position(from, psi), after = rest_position(to, psi);
  state[index::x] += after[0] - before[0];
  state[index::y] += after[1] - before[1];
}

}  // namespace equipoise::model
