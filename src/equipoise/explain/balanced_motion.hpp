// The motion near balance, linearised: how fast balls settle there.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "equipoise/model/balanced_state.hpp"
#include "equipoise/results/explanation.hpp"

namespace equipoise {

/// The balls' angles in one balanced state of these; of a continuum far from its ends, and where balls of these widths
/// have room beside each other. None if there is none.
std::optional<std::array<double, model::max_balls>> balanced_angles(const model::BalancedStates& states,
                                                                    const model::Parameters& p,
                                                                    const std::vector<double>& width = {});

/// Fills `e.motion`, or `e.no_motion` with why not. Where the equations change with the rotor's angle: by the
/// multipliers of the motion that a balanced state becomes. Gravity is left out where it leaves no such motion, of a
/// continuum, or the weight of a ball exceeds its centrifugal force.
void linearise(Explanation& e);

}  // namespace equipoise
