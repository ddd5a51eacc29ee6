// Equilibria and periodic orbits of systems with events, by the map that takes a state to where it is a period later.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/ball_events.hpp"

namespace equipoise {

// The mode of balls follows from the state (BallMode). Touching balls, move alike and press count as one; held balls
// do not count. Both refine functions work in the remaining coordinates, with derivatives by differences; spectra have
// as many values.

/// The mode in which a trajectory from `state` begins.
model::BallMode mode_at(const model::System& system, const Eigen::VectorXd& state);

/// Newton's method from `guess` on the equations of its mode, for a system without a stroboscopic section. Empty if it
/// does not converge. If all balls are held, the equilibrium is the rotor's.
std::optional<Equilibrium> refine_mode_equilibrium(const model::System& system, const Eigen::VectorXd& guess);

/// Newton's method on the return map from `state`, which returns after about `period` (on a stroboscopic section:
/// exactly). Impacts on the way are part of the map and its derivative; theory writes them as saltation matrices. The
/// orbit has one node; multipliers are good to about 1e-6. Empty if it does not converge, or goes further than `reach`
/// (in StateDifference's sizes).
std::optional<PeriodicOrbit> refine_return(const model::System& system, const Eigen::VectorXd& state, double period,
                                           double reach);

/// The state after `duration`, in steps a thousand times as accurate as an ensemble's; empty if the trajectory is lost.
std::optional<Eigen::VectorXd> after(const model::System& system, const Eigen::VectorXd& state, double duration);

}  // namespace equipoise
