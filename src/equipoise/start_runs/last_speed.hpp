// How fast rotors turn that are undecided: over their last turns, not over a long window that may lie in their run-up.
#pragma once

#include <vector>

#include "equipoise/batch/batch_task.hpp"

namespace equipoise {

/// Eight turns at the critical speed: what tells the speed of a start that stays open.
inline constexpr double last_turns = 50.0;

/// Mean psi' of driven rotors over last_turns from where they are: `states` (a row each) at `now`. `task` holds their
/// equations; `own`: their own rotors, each at its end now, or none. One that is lost on the way has the speed that it
/// was lost with. Empty if stopped early.
std::vector<double> mean_speeds_from(BatchTask task, std::vector<double> states, double now,
                                     std::vector<OwnRotor> own = {});

}  // namespace equipoise
