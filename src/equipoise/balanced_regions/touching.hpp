// What contact leaves of trapping regions of balls that pass each other.
#pragma once

#include "equipoise/classification/classification_rule.hpp"
#include "equipoise/model/system.hpp"

namespace equipoise {

/// Angles between balls side by side, in contact angles: clear of what rounding makes of touching.
inline constexpr double side_by_side = 1.0 + 1e-6;

/// The level of a trapping region at which two balls could touch: on d^T P d = c the angle between two balls deviates
/// by at most sqrt(c l^T P^-1 l), l the difference of their angles. Infinite where balls pass each other; 0 if they
/// would overlap in balance itself.
double touching_level(const model::System& system, const BalancedRegion& region);

}  // namespace equipoise
