// Pieces shared by the ways to describe a motion.
#pragma once

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise {

/// Fills everything that follows from statistics: r, rates, speed, drift and what the balls do. Kind, period and
/// winding must be set.
void describe_statistics(const model::System& system, const MotionStatistics& statistics, Motion& motion);

/// Whether statistics of a measured motion are long enough to show which balls drift, and which of them alike.
bool drifts_are_known(const model::Parameters& p, const MotionStatistics& statistics, const Motion& motion);

/// A motion at rest, but for what of it is stable or a copy.
Motion motion_at_rest(const model::System& system, const Equilibrium& equilibrium);
/// A periodic motion, but for what follows from statistics.
Motion motion_on_orbit(const model::System& system, const PeriodicOrbit& orbit, const Eigen::VectorXcd& spectrum);

/// r of a system at rest at `state`, from its sag under gravity.
double r_at_rest(const model::System& system, const Eigen::VectorXd& state);

/// Whether no eigenvalue has a positive real part, and at most `zeros_allowed`, those of a continuum, are zero.
bool attracts(const Eigen::VectorXcd& eigenvalues, int zeros_allowed);

}  // namespace equipoise
