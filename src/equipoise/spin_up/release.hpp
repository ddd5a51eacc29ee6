// The time in a step at which a driven rotor comes to the speed where its balls are let go.
#pragma once

#include <optional>

#include "equipoise/deciding/held.hpp"
#include "equipoise/model/system.hpp"

namespace equipoise {

/// From `state` (model/held_state.hpp) at time `from` on, to `to` at the latest, over the piece of a drive that the
/// system holds; `state` is then that at the time answered. Empty if the rotor does not come to rule.release_speed, or
/// is lost: `state` is then that at `to`.
std::optional<double> find_release(const model::System& system, const HoldRule& rule, double from, double to,
                                   double* state);

}  // namespace equipoise
