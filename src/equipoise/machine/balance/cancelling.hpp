// Which unbalances a set of balls can cancel, given their masses and, if they collide, their sizes; and ball angles that
// cancel the eccentricity: side by side on the light side of the race, or spread round it.
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

/// Ball angles of a fan: the heaviest ball in the middle and equal gaps, chosen so that the balls cancel p.eccentricity
/// to rounding. p.eccentricity must lie between what they cancel without gaps and with gaps all round. `width`: the
/// angle that each ball takes up.
std::array<double, max_balls> fan(const Parameters& p, const std::vector<double>& width);

/// Ball angles that cancel p.eccentricity: laid end to end, unbalance and balls in their order are the sides of a
/// polygon inscribed in a circle, which no other order of directions with these sides surpasses in area. Smooth in the
/// parameters up to where balance ends, with all balls in line. For rotors that do not tilt and have a balanced state.
std::array<double, max_balls> inscribed_polygon(const Parameters& p);

}  // namespace equipoise::model
