// Transfers a state to a rotor that sags differently.
#pragma once

#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"

namespace equipoise::model {

/// Shifts the centre of a state at rotor angle `psi`: it keeps its distance from the rest position, now that of `to`
/// instead of `from`. A soft rotor sags by more than it ever vibrates.
inline void hang_anew(const Parameters& from, const Parameters& to, double psi, double* state) {
  const auto before = rest_position(from, psi), after = rest_position(to, psi);
  state[index::x] += after[0] - before[0];
  state[index::y] += after[1] - before[1];
}

}  // namespace equipoise::model
