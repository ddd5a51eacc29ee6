// Mean speeds of undecided rotors over their last turns, as a long window may still contain the run-up.
#pragma once

#include <vector>

#include "equipoise/simulation/batch/batch_task.hpp"

namespace equipoise {

/// Time for eight turns at the critical speed, over which the speed of an undecided start is averaged.
inline constexpr double last_turns = 50.0;

/// Mean psi' of driven rotors over last_turns, from `states` (a row each) at time `now`. `task` holds their equations,
/// `own` their own rotors, each at its end now, or none. A rotor lost on the way has its speed when lost. Empty if
/// stopped early.
std::vector<double> mean_speeds_from(BatchTask task, std::vector<double> states, double now,
                                     std::vector<OwnRotor> own = {});

}  // namespace equipoise
