// Finds when a driven rotor reaches the release speed of its balls.
#pragma once

#include <optional>

#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/rule/release_rule.hpp"

namespace equipoise {

/// Follows `state` (machine/model/held_state.hpp) from `from` until the rotor reaches rule.release_speed, but at most
/// to `to`. Empty if it does not reach it, or is lost. `state` ends at the returned time, else at `to`.
std::optional<double> find_release(const model::System& system, const ReleaseRule& rule, double from, double to,
                                   double* state);

}  // namespace equipoise
