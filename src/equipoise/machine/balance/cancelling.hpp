// Which unbalances a set of balls can cancel, given their masses and, if they collide, their sizes.
#pragma once

#include <array>
#include <vector>

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// Why one ball has no balanced state.
inline constexpr char lone_ball[] = "one ball alone cancels its own unbalance, neither more nor less";

/// The values of |sum mu_i e^{i phi_i}| that balls can reach without overlap. Balls keep their order in the race. Each
/// order reaches one interval; these are the intervals of all orders, merged. Where many unlike balls have more orders
/// than can be tried, and the first does not reach all that balls without size would, they are those of some orders.
struct Cancelling {
  /// Disjoint and increasing; usually one. Empty if the balls do not fit into the race.
  std::vector<std::array<double, 2>> ranges;

  bool fit() const { return !ranges.empty(); }
  double least() const { return fit() ? ranges.front()[0] : 0.0; }
  double most() const { return fit() ? ranges.back()[1] : 0.0; }
  bool cancels(double unbalance) const;
  bool all_tried = true;  ///< no order can reach anything else
  /// Why they cannot cancel it, as text after a colon; where `all_tried` is false, what was tried.
  const char* why_not(double unbalance) const;
  bool lone = false;       ///< a single ball
  double uncertain = 0.0;  ///< error of the ends: 1e-6 of all masses; rounding for balls without size
};

/// `width`: the angle that each ball takes up, seen from the race's centre; empty if balls pass each other.
Cancelling cancelling(const Parameters& p, const std::vector<double>& width);

/// The same for the balls of `p`, with their contact angle if they collide.
Cancelling cancelling(const Parameters& p);

}  // namespace equipoise::model
