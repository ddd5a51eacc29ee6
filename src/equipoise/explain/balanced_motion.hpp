// The motion near balance, linearised: how fast balls settle there.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "equipoise/mechanics/balanced_state.hpp"
#include "equipoise/results/explanation.hpp"

namespace equipoise {

/// The balls' angles in one of the balanced states; of a continuum far from its ends, with room for balls of these
/// widths. None if there is none.
std::optional<std::array<double, model::max_balls>> balanced_angles(const model::BalancedStates& states,
                                                                    const model::Parameters& p,
                                                                    const std::vector<double>& width = {});

/// Fills `e.motion`, or `e.no_motion` with why not. Where the equations depend on the rotor's angle, by the multipliers
/// of the motion that a balanced state becomes. Gravity is left out of a continuum, and where a ball's weight exceeds
/// its centrifugal force.
void linearise(Explanation& e);

}  // namespace equipoise
