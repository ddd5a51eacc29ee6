// The box of balance, for a continuum of balanced states of which nothing is at rest.
#pragma once

#include <optional>

#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// Under gravity, or under a motor if the rotor's angle matters, balls creep along a continuum of balanced states,
/// touch and part again. Their motion does not come back for thousands of turns, and the member that they are at does
/// not matter to the rotor. So balanced means that windows stay balanced: the rotor vibrates at most half as much as
/// without balls (halves_the_shaking()), and no ball drifts. That must last for ten e-foldings of the fastest growth
/// or, without growth, five of the slowest decay. Empty for all other systems, and if there is no balance.
std::optional<FeatureBox> balance_box(const model::System& system, const BalancedAnalysis& balanced, double window,
                                      double horizon);

}  // namespace equipoise
