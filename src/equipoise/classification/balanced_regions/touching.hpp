// How contact limits trapping regions made for balls that pass each other.
#pragma once

#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// Angle between balls side by side, in contact angles: clear of touching by more than rounding.
inline constexpr double side_by_side = 1.0 + 1e-6;

/// The level of a trapping region at which two balls could touch. On d^T P d = c the angle between two balls deviates
/// by at most sqrt(c l^T P^-1 l), with l the difference of their angles. Infinite if balls pass each other; 0 if they
/// would overlap in balance.
double touching_level(const model::System& system, const BalancedRegion& region);

}  // namespace equipoise
