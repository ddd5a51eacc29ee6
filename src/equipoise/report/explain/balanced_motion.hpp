// The motion near balance, linearised: how fast balls settle there.
#pragma once

#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/results/commands/explanation.hpp"

namespace equipoise {

/// Fills `e.motion`, or `e.no_motion` with why not. Where the equations depend on the rotor's angle, by the multipliers
/// of the motion that a balanced state becomes. Gravity is left out of a continuum, and where a ball's weight exceeds
/// its centrifugal force.
void linearise(Explanation& e, const StopFlag* stop);

}  // namespace equipoise
