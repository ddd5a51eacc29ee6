// Driven rotors whose balls are held until the rotor comes to a speed: what they are asked, and how they end.
#pragma once

#include <limits>
#include <vector>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

/// When balls that are held are let go, or given up.
struct HoldRule {
  double release_speed = std::numeric_limits<double>::infinity();  ///< infinite: at no speed
  std::vector<double> own_speeds{};  ///< of each trajectory, where rotors are their own; empty: the same of all
  bool rising = true;                ///< they are let go from that speed on; else from that speed down
  DecisionRule windows;  ///< says by its windows, all else empty, when a rotor that did not come there is steady
};

struct HeldEnd {
  /// Undecided at the task's end; attracted where it is steady, or undecided before the end where it runs away.
  Fate fate;
  /// It came to release_speed in the step from `fate.time` to `crossed_by`, or seemed to: its state is that at
  /// `fate.time`.
  bool crossing = false;
  double crossed_by = 0.0;
  double nearest = 0.0;  ///< of all speeds that it had the one nearest to release_speed
};

}  // namespace equipoise
