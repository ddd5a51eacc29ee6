// Equilibria and periodic orbits of systems with events, by the map that takes a state to where it is a period later.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/model/system.hpp"
#include "equipoise/periodic_orbits/orbit.hpp"
#include "equipoise/types/ball_events.hpp"

namespace equipoise {

// What balls do at a state follows from the state (BallMode): those that touch, move alike and press are one ball,
// those that rest and are held are none. Both functions work in the coordinates that are left, with derivatives by
// differences; spectra have as many values.

/// The mode in which a trajectory from `state` begins.
model::BallMode mode_at(const model::System& system, const Eigen::VectorXd& state);
/// The least angle between two neighbours beyond touching; infinite for one ball.
double least_gap(const model::Parameters& p, const Eigen::VectorXd& state);
/// Whether balls that collide would lie in each other at these angles.
bool overlap(const model::Parameters& p, const double* phi);

/// Newton's method from `guess` on the equations of its mode, of a system without strobes. Empty if it does not
/// converge. Where all balls are held it is the rotor's.
std::optional<Equilibrium> refine_mode_equilibrium(const model::System& system, const Eigen::VectorXd& guess);

/// Newton's method on the return map from `state`, which returns after about `period` (of section strobe: after exactly
/// that). Impacts on the way are part of the map, and with them of its derivative: what theory writes as saltation
/// matrices. The orbit has one node; multipliers are good to about 1e-6. Empty if it does not converge or goes farther
/// than `reach` (in StateDifference's sizes).
std::optional<PeriodicOrbit> refine_return(const model::System& system, const Eigen::VectorXd& state, double period,
                                           double reach);

/// Where the trajectory from `state` is after `duration`, in steps a thousand times as accurate as an ensemble's; empty
/// if it is lost.
std::optional<Eigen::VectorXd> after(const model::System& system, const Eigen::VectorXd& state, double duration);

}  // namespace equipoise
