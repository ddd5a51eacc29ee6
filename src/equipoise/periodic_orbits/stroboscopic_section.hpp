// What is particular to systems that depend on the rotor's angle: the way from one strobe to the next, and which of
// their orbits are balanced. The orbits themselves: periodic_orbits/orbit.hpp.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/model/system.hpp"
#include "equipoise/periodic_orbits/orbit.hpp"

namespace equipoise {

// Everywhere: states of section strobe without an angle beside them hold where psi = 0.

/// The state at the next strobe, from `state` when the rotor's angle is `psi`. A state at a strobe is left as it is,
/// and so is any of another section. Empty if the integration fails.
std::optional<Eigen::VectorXd> at_next_section(const model::System& system, const Eigen::VectorXd& state, double psi,
                                               double tolerance = 1e-12);

/// The orbit that a balanced state at ball angles `phi` becomes as gravity and anisotropy are switched on gradually.
/// Empty if there is none: it may meet another one and vanish on the way. `reached`, if given: the share of both to
/// which it could be followed.
std::optional<PeriodicOrbit> balanced_orbit(const model::System& system, const double* phi, double* reached = nullptr);

/// The same the other way round: as gravity and anisotropy are switched off gradually, the orbit becomes a balanced
/// state (its centre comes to rest on the axis).
bool leads_to_balance(const model::System& system, const PeriodicOrbit& orbit);

/// The same, on section strobe, for a motion that is no such orbit (along what gravity leaves of a continuum of
/// balanced states balls creep for ever): while gravity and anisotropy fade over 400 strobes the trajectory from
/// `state` comes to balance, and no ball passes a quarter of a turn.
bool relaxes_to_balance(const model::System& system, const Eigen::VectorXd& state);

}  // namespace equipoise
