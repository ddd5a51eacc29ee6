// Motions of systems with events: contact, rolling resistance, stiction.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/attractors/approach.hpp"
#include "equipoise/model/system.hpp"

namespace equipoise {

/// What settle() does of a system with events. A trajectory on which nothing touches or sticks any more is one of the
/// system without contact, and its motion is refined there, if no balls touch on it. Else it is a rotor whose balls all
/// stick (attractors/stuck.hpp), an equilibrium or a periodic orbit in which some balls touch or stick, or events recur
/// (periodic_orbits/return_map.hpp), or else told by its statistics and the rate at which neighbours part.
Approach settle_with_events(const model::System& system, const Eigen::VectorXd& state, double patience,
                            const StopFlag* stop);

/// Whether no balls touch on a motion that is one of the system without contact.
bool stays_clear(const model::System& system, const Motion& motion);

/// The same system with balls that pass each other and do not stick.
model::System without_events(const model::System& system);

}  // namespace equipoise
