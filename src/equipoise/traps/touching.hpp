// What contact leaves of traps of balls that pass each other.
#pragma once

#include <array>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/model/parameters.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/orbits/balanced_continuum.hpp"

namespace equipoise {

/// Angles between balls side by side, in contact angles: clear of what rounding makes of touching.
inline constexpr double side_by_side = 1.0 + 1e-6;

/// Whether balls at these angles have room beside each other.
bool has_room(const model::Parameters& p, const std::array<double, model::max_balls>& phi);

/// The level of a trap at which two balls could touch: on d^T P d = c the angle between two balls deviates by at most
/// sqrt(c l^T P^-1 l), l the difference of their angles. Infinite where balls pass each other; 0 if they would overlap
/// in balance itself.
double touching_level(const model::System& system, const BalancedTrap& trap);

/// Leaves those members of a survey whose balls have room; the typical one then is one of them, if any is left.
void keep_members_with_room(const model::Parameters& p, ContinuumSurvey& survey);

}  // namespace equipoise
