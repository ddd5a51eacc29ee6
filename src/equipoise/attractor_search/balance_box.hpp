// What balance looks like where nothing of a continuum of balanced states is at rest.
#pragma once

#include <optional>

#include "equipoise/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/classification_rule.hpp"

namespace equipoise {

/// Under gravity, and under a motor where the rotor's angle matters, balls creep along a continuum of balanced states,
/// come to touch, and part again; no motion of theirs comes back for thousands of turns, and which member they are at
/// is no matter to the rotor. Balanced is then what stays so: windows in which the rotor shakes at most half as much as
/// it would without balls (halves_the_shaking()) and no ball drifts, for ten times as long as deviations take to grow
/// e-fold or, where none does, for five times as long as they take to die out. Empty for all other systems, and where
/// there is no balance.
std::optional<FeatureBox> balance_box(const model::System& system, const BalancedAnalysis& balanced, double window,
                                      double horizon);

}  // namespace equipoise
