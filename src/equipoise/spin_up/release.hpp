// When a driven rotor reaches the release speed of its balls.
#pragma once

#include <optional>

#include "equipoise/classification/held.hpp"
#include "equipoise/model/system.hpp"

namespace equipoise {

/// Follows `state` (model/held_state.hpp) from `from` until the rotor reaches rule.release_speed, or to `to`. Empty if
/// it does not, or is lost. `state` ends at the time answered, else at `to`.
std::optional<double> find_release(const model::System& system, const HoldRule& rule, double from, double to,
                                   double* state);

}  // namespace equipoise
