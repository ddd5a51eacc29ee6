// Driven rotors whose balls are held until the rotor reaches a speed: the rule of release, and how trajectories end.
#pragma once

#include <limits>
#include <vector>

#include "equipoise/classification/classification_rule.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

/// When held balls are released, or the trajectory is given up.
struct HoldRule {
  double release_speed = std::numeric_limits<double>::infinity();  ///< infinite: at no speed
  std::vector<double> own_speeds{};  ///< of each trajectory, where rotors are their own; empty: the same of all
  bool rising = true;                ///< they are let go from that speed on; else from that speed down
  ClassificationRule windows;  ///< says by its windows, all else empty, when a rotor that did not come there is steady
};

struct HeldEnd {
  /// Attracted if it is steady; undecided at the task's end, or before it if the rotor runs away.
  Fate fate;
  /// It reached release_speed in the step from `fate.time` to `crossed_by`, or seemed to. Its state is that at
  /// `fate.time`.
  bool crossing = false;
  double crossed_by = 0.0;
  double nearest = 0.0;  ///< the speed nearest to release_speed that it had
};

}  // namespace equipoise
