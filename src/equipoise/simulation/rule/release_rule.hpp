// Driven rotors whose balls are clamped until the rotor reaches a speed: the rule of release, and how trajectories end.
#pragma once

#include <limits>
#include <vector>

#include "equipoise/results/types/fate.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// When clamped balls are released, or the trajectory is given up.
struct ReleaseRule {
  double release_speed = std::numeric_limits<double>::infinity();  ///< infinite: never
  std::vector<double> own_speeds{};  ///< each trajectory's, if they have rotors of their own; else empty
  bool rising = true;                ///< released from that speed on; else from that speed down
  ClassificationRule windows;  ///< only its windows are set: they decide when a rotor that never gets there is steady
};

struct ClampedEnd {
  /// Attracted if steady; undecided at the task's end, or earlier if the rotor runs away.
  Fate fate;
  /// Whether it reached release_speed, or seemed to, in the step from `fate.time` to `crossed_by`. Its state is that at
  /// `fate.time`.
  bool crossing = false;
  double crossed_by = 0.0;
  double nearest = 0.0;  ///< the speed that came nearest to release_speed
};

}  // namespace equipoise
