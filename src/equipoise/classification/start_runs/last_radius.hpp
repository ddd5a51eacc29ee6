// The largest r of trajectories whose outcome is known, measured as they go on.
#pragma once

#include <vector>

#include "equipoise/simulation/batch/batch_task.hpp"

namespace equipoise {

/// A trajectory with a rotor of its own, at the time at which its outcome was known.
struct KnownTrajectory {
  OwnRotor rotor;
  double time = 0.0;
  double window = 0.0;  ///< long enough to show how it moves: ClassificationRule::first_long_window
};

/// The largest r of the motion that each settles into, to 2 %: it is followed, from `states` (a row each), until
/// windows of time agree. Not a number if they never do, or if it is lost. `task` holds the equations. Empty if stopped
/// early.
std::vector<float> steady_radii(BatchTask task, std::vector<double> states, std::vector<KnownTrajectory> known);

}  // namespace equipoise
