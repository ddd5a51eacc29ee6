// Takes a trajectory, an equilibrium or an orbit to its steady motion.
// This room: from a trajectory to its attractor: kind, figures, name.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/motion.hpp"

namespace equipoise {

/// How long a trajectory may take to become steady.
inline constexpr double motion_patience = 20000.0;

/// Follows the trajectory from `state` (on the stroboscopic section, if there is one) until it is steady; decides its
/// kind, refines and describes it. `patience`: the longest time to follow. Empty if it does not become steady,
/// diverges, or `stop` is set. Otherwise deterministic.
std::optional<Motion> motion_from(const model::System& system, const Eigen::VectorXd& state,
                                  double patience = motion_patience, const StopFlag* stop = nullptr);
/// Newton's method in this system from `guess`, a neighbouring system's motion: an equilibrium or periodic motion,
/// stable or not. Empty if it finds none, or one on which balls in contact would touch.
std::optional<Motion> refined_motion(const model::System& system, const Motion& guess, const StopFlag* stop = nullptr);
/// Describe refined states as motion_from() does.
Motion describe_equilibrium(const model::System& system, const Equilibrium& equilibrium);
Motion describe_orbit(const model::System& system, const PeriodicOrbit& orbit);
/// Balance under gravity with three balls or more: the motion along what gravity leaves of a continuum of balanced
/// states. `state` lies next to it; deviations across it die out at `rate`.
Motion describe_creep(const model::System& system, const Eigen::VectorXd& state, double rate);

/// The system that has this motion.
model::System system_of(const model::Parameters& p, const Motion& motion);

/// The same motion, up to a shift in time, whole turns and exchange of alike balls. Orbits and equilibria are compared
/// as point sets to 1e-6, others by their statistics.
bool same_motion(const model::Parameters& p, const Motion& a, const Motion& b);

/// The name that follows from its topology.
MotionName motion_name(const model::Parameters& p, const Motion& motion);

}  // namespace equipoise
