// What balance does at one point of a plane: a study's.
#pragma once

#include <optional>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/extras/planes/stability_plane.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// By eigenvalues at the balanced state, or multipliers where the equations depend on the rotor's angle. Of several
/// isolated states the more stable one; of a continuum the member that balanced_angles() finds. A motor that holds its
/// speed takes part in the motion, unless gravity or unequal supports act. The study has balls and nothing uncertain.
/// Once `stop` is set, rates stay unknown.
BalancePoint balance_at(const Study& study, const StopFlag* stop = nullptr);

/// Of a study whose balanced states form a continuum: which part of it is stable, by members drawn evenly, as
/// ContinuumOfEquilibria samples it. Empty for other studies, and where no members were found.
std::optional<ContinuumPart> continuum_at(const Study& study, const StopFlag* stop = nullptr);

}  // namespace equipoise
