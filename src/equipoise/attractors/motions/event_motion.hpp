// Motions of systems with events: contact, rolling resistance, stiction.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/attractors/motions/approach.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// Does settle() for a system with events. If nothing touches or sticks any more, the motion belongs to the system
/// without contact; it is refined there if no balls touch on it. Otherwise it is a rotor whose balls all stick
/// (attractors/equilibria/stuck.hpp); an equilibrium or periodic orbit on which balls touch or stick, or events recur
/// (attractors/periodic_orbits/return_map.hpp); or it is identified by statistics and the rate at which neighbours
/// part.
Approach settle_with_events(const model::System& system, const Eigen::VectorXd& state, double patience,
                            const StopFlag* stop);

/// Whether no balls touch on a motion of the system without contact.
bool stays_clear(const model::System& system, const Motion& motion);

/// The same system with balls that pass each other and do not stick.
model::System without_events(const model::System& system);

}  // namespace equipoise
