// The stroboscopic map of a rotor with anisotropic supports or gravity: from one strobe to the next, that is after
// every turn by model::strobe_angle(); its periodic orbits, their multipliers, and which of them are balanced.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/model/parameters.hpp"
#include "equipoise/orbits/orbit.hpp"

namespace equipoise {

// Everywhere: speed is not 0, and states without an angle beside them hold at a strobe, where psi = 0.

/// The state at the next strobe, from `state` when the rotor's angle is `psi`; a state at a strobe is left as it is.
/// Empty if the integration fails.
std::optional<Eigen::VectorXd> at_next_strobe(const model::Parameters& p, double speed, const Eigen::VectorXd& state,
                                              double psi);

/// Newton's method for a motion that comes back after as many strobes as `guess` has states (those at successive
/// strobes, angles unwrapped): multiple shooting from strobe to strobe with exact derivatives, condensed to the first
/// state; where the map's derivative minus one is singular, the least change. In the answer `nodes` are the states at
/// successive strobes, `multipliers` are all that there are, by falling modulus (the period is imposed, so none belongs
/// to a shift in time), and an equilibrium is an orbit like any other. Empty if it does not converge within `reach` (in
/// state_scale()) of the guess. The period returned is the smallest.
std::optional<PeriodicOrbit> refine_strobed(const model::Parameters& p, double speed,
                                            const std::vector<Eigen::VectorXd>& guess, double reach = 0.5);

/// Whether at most `units_allowed` multipliers lie on the unit circle, at 1, and all others inside.
bool contracts(const Eigen::VectorXcd& multipliers, int units_allowed = 0);

/// The orbit that a balanced state at ball angles `phi` becomes as gravity and anisotropy are switched on gradually.
/// Empty if there is none: it may meet another one and vanish on the way.
std::optional<PeriodicOrbit> balanced_orbit(const model::Parameters& p, double speed, const double* phi);

/// The same the other way round: as gravity and anisotropy are switched off gradually, the orbit becomes a balanced
/// state (its centre comes to rest on the axis).
bool leads_to_balance(const model::Parameters& p, double speed, const PeriodicOrbit& orbit);

/// The same for a motion that is no such orbit (along what gravity leaves of a continuum of balanced states balls creep
/// for ever): while gravity and anisotropy fade over 400 strobes the trajectory from `state` comes to balance, and no
/// ball passes a quarter of a turn.
bool relaxes_to_balance(const model::Parameters& p, double speed, const Eigen::VectorXd& state);

/// The two largest Lyapunov exponents over `strobes` strobes; an exponent of 0 that belonged to a shift in time is not
/// among them. Empty if the integration fails, and once `stop` is set.
std::vector<double> strobed_exponents(const model::Parameters& p, double speed, const Eigen::VectorXd& state,
                                      long strobes, const StopFlag* stop = nullptr);

}  // namespace equipoise
