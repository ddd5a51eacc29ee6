// Follows a rotor and its held balls, as one body, through the whole drive to the motion that it comes to; a rotor
// without balls is one whose balls weigh nothing.
#pragma once

#include <limits>
#include <optional>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/results/types/status.hpp"
#include "equipoise/results/types/transient_table.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

struct HeldRun {
  TransientSums sums;                ///< with the motion at the end in their last window
  std::optional<MotionFigures> end;  ///< of that motion, where it is known exactly: damped, at a prescribed speed
  double speed = 0.0;                ///< mean psi' in the end
  bool steady = false;               ///< that motion goes on as it is; else what was last seen
  bool lost = false;                 ///< diverged, or the integrator failed
  /// Study time at which the balls would be released; infinite: never.
  double released = std::numeric_limits<double>::infinity();
};

/// From `start`, whose ball rates do not count. The study must have its horizon, beyond which no motor is followed; one
/// that lets go of its rotor, and a rotor without damping, less far. Once `stop` is set, what is returned is worthless.
HeldRun follow_held(const Study& study, const InitialState& start, const TransientSettings& settings,
                    const StopFlag* stop = nullptr);

/// Takes the weight from the balls of study and start. The rotor begins as far from its place of rest as before.
void take_balls_off(Study& study, InitialState& start);

}  // namespace equipoise
