// Capture by a continuum of balanced states (three balls or more, or two equal balls without unbalance).
#pragma once

#include "equipoise/attractors/decision_rule.hpp"

namespace equipoise {

/// A test for states near the continuum: the nearest balanced state is linearly stable across it, and the state lies in
/// a level set of a Lyapunov function on the stable directions, small enough that the remainder of the linearisation
/// (sampled, with a margin) cannot make it grow. A state that passes converges to some balanced state near by.
FamilyTrap family_trap(const model::Parameters& p, double speed);

}  // namespace equipoise
