// The normal form of a Hopf bifurcation: what a swing does that is a little too large for linear theory.
#pragma once

#include <optional>

#include "equipoise/extras/stability/balance_at.hpp"

namespace equipoise {

struct HopfForm {
  double frequency = 0.0;
  /// Growth rate = Re(eigenvalue) + lyapunov a^2, where a is the amplitude, in radians, of the ball that swings most.
  double lyapunov = 0.0;
};
/// At a state of which a pair with about this frequency lies on the imaginary axis. First Lyapunov coefficient as in
/// Kuznetsov, Elements of Applied Bifurcation Theory, section 5.4, with exact derivatives and this scale of the
/// eigenvector. Empty for a member of a continuum, under a motor, and where the pair is no pair or another eigenvalue
/// is 0.
std::optional<HopfForm> hopf_form(const BalanceSpectrum& at, double frequency);

}  // namespace equipoise
