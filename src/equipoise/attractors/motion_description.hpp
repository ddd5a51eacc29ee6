// Pieces shared by the ways to describe a motion.
#pragma once

#include <Eigen/Core>

#include "equipoise/attractors/motion.hpp"
#include "equipoise/attractors/motion_statistics.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// Fills what follows from statistics: r, rates, speed, drift and what the balls do. Kind, period and winding must be
/// there.
void describe_statistics(const model::System& system, const MotionStatistics& statistics, Motion& motion);

/// Whether statistics of a measured motion are long enough to tell which balls drift, and which of them alike.
bool drifts_are_known(const model::Parameters& p, const MotionStatistics& statistics, const Motion& motion);

/// The part of that which tells what pairs of balls do.
void describe_pairs(const model::Parameters& p, const MotionStatistics& statistics, Motion& motion);

/// Of a motion that rests in the rotating frame, at motion.state: what turns the rotor, and the angles between balls.
void describe_rest(const model::System& system, Motion& motion);

/// r of a system at rest at `state`, from where gravity lets it sag to.
double r_at_rest(const model::System& system, const Eigen::VectorXd& state);

/// No eigenvalue has a positive real part, and at most `zeros_allowed` are zero: those of a continuum.
bool attracts(const Eigen::VectorXcd& eigenvalues, int zeros_allowed);

}  // namespace equipoise
