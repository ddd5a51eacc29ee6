// Systems that depend on the rotor's angle: the way to the next stroboscopic section, and which orbits are balanced.
// The orbits themselves: attractors/periodic_orbits/orbit.hpp.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/machine/model/system.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"

namespace equipoise {

// Throughout, states on a stroboscopic section without an angle belong to psi = 0.

/// The state on the next section, from `state` at rotor angle `psi`. A state on the section stays as it is, and so does
/// one of a system with another kind of section. Empty if the integration fails.
std::optional<Eigen::VectorXd> at_next_section(const model::System& system, const Eigen::VectorXd& state, double psi,
                                               double tolerance = 1e-12);

/// The orbit that a balanced state at ball angles `phi` becomes as gravity and anisotropy are switched on gradually.
/// Empty if there is none: it may meet another orbit and vanish. `reached`: the share of both up to which it was
/// continued.
std::optional<PeriodicOrbit> balanced_orbit(const model::System& system, const double* phi, double* reached = nullptr,
                                            const StopFlag* stop = nullptr);

/// Whether the orbit becomes a balanced state (its centre comes to rest on the axis) as gravity and anisotropy are
/// switched off gradually.
bool leads_to_balance(const model::System& system, const PeriodicOrbit& orbit);

/// The same on a stroboscopic section for a motion that is no such orbit: along the rest of a continuum of balanced
/// states under gravity, balls creep for ever. While gravity and anisotropy fade over 400 sections, the trajectory from
/// `state` must become balanced, and no ball may pass a quarter turn.
bool relaxes_to_balance(const model::System& system, const Eigen::VectorXd& state);

}  // namespace equipoise
