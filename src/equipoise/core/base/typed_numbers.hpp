// Comparisons with numbers that people type: in other units the same quantity differs by roundings.
#pragma once

#include <algorithm>
#include <cmath>

namespace equipoise {

/// Relative. A conversion of units errs by some 1e-15; no one types ten digits that matter.
inline constexpr double typed_rounding = 1e-9;

inline bool at_most(double value, double limit) { return value <= limit + typed_rounding * std::abs(limit); }
inline bool same_quantity(double a, double b) {
  return std::abs(a - b) <= typed_rounding * std::max(std::abs(a), std::abs(b));
}

}  // namespace equipoise
