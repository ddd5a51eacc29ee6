// The unbalance of rotor and balls.
#pragma once

#include <complex>

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// Mass times place of the common centre of mass, from the shaft's centre and in the rotating frame:
/// lambda + sum mu_i (e + e^{i phi_i}), e the centre of the race. `phi`: one angle a ball.
std::complex<double> unbalance(const Parameters& p, const double* phi);

}  // namespace equipoise::model
