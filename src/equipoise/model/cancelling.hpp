// Which unbalances balls can cancel: by their masses and, where they have a size, by the room beside each other.
#pragma once

#include <array>
#include <vector>

#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// The sums |sum mu_i e^{i phi_i}| that balls can make without overlapping. Balls keep their order in the race; of one
/// order all values between two ends can be made, and the ranges of all orders are joined here.
struct Cancelling {
  /// By growing values, apart from each other; mostly one. None: the balls do not fit into the race.
  std::vector<std::array<double, 2>> ranges;

  bool fit() const { return !ranges.empty(); }
  double least() const { return fit() ? ranges.front()[0] : 0.0; }
  double most() const { return fit() ? ranges.back()[1] : 0.0; }
  bool cancels(double unbalance) const;
  /// Why not, where they do not cancel it: words that follow a colon.
  const char* why_not(double unbalance) const;
  double uncertain = 0.0;  ///< of the ends: 1e-6 of all masses; of balls without a size roundings
};

/// `width`: part of the race that each ball takes, an angle seen from the race's centre; none where balls pass each
/// other.
Cancelling cancelling(const Parameters& p, const std::vector<double>& width);

/// The same of balls as they are: where they collide, with the angle at which they touch.
Cancelling cancelling(const Parameters& p);

}  // namespace equipoise::model
