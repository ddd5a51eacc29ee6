// What balance does at one point of a plane: a study's.
#pragma once

#include "equipoise/planes/stability_plane.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// By eigenvalues at the balanced state, or multipliers where the equations depend on the rotor's angle. Of several
/// isolated states the more stable one; of a continuum the member that balanced_angles() finds. A motor that holds its
/// speed takes part in the motion, unless gravity or unequal supports act. The study has balls and nothing uncertain.
BalancePoint balance_at(const Study& study);

}  // namespace equipoise
