// Proofs of what balance does everywhere in a box of parameters: two balls of equal drag that slide in a centred race,
// at a prescribed speed on equal supports without gravity.
#pragma once

#include <array>

#include "equipoise/core/math/affine_form.hpp"
#include "equipoise/extras/planes/bifurcation_chart.hpp"

namespace equipoise {

/// A number that depends on the two coordinates of a box, each from -1 to 1, up to a bound.
using BoxNumber = AffineForm<2>;

/// The rotor's parameters over a box (machine/model/parameters.hpp); `speed` is psi'.
struct BoxRotor {
  BoxNumber speed, damping, stiffness, drag, eccentricity;
  std::array<BoxNumber, 2> mass;
};

/// The coefficients, lowest first, of the polynomial whose zeros are the eigenvalues at balance over the speed: times
/// a positive number, the characteristic polynomial. docs/explanation/equations.md, "Eigenvalues at balance".
std::array<BoxNumber, 9> balance_polynomial(const BoxRotor& rotor);

/// What balance is everywhere in the box; `none`: nowhere a balanced state exists; `open`: not decided. By Routh's
/// array (E. J. Routh, 1877) in affine arithmetic, which rounds outwards.
BalanceKind judge_box(const BoxRotor& rotor);

}  // namespace equipoise
