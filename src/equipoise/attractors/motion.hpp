// From a trajectory, an equilibrium or an orbit to the steady motion that it is.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/model/parameters.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/periodic_orbits/orbit.hpp"
#include "equipoise/types/motion.hpp"

namespace equipoise {

/// How long a trajectory is given to become steady.
inline constexpr double motion_patience = 20000.0;

/// Follows the trajectory from `state` (of a strobed system at a strobe) until it is steady, decides the kind, refines
/// and describes. `patience`: the longest time to follow it. Empty if it does not become steady, or diverges, or once
/// `stop` is set. Else deterministic.
std::optional<Motion> motion_from(const model::System& system, const Eigen::VectorXd& state,
                                  double patience = motion_patience, const StopFlag* stop = nullptr);
/// What Newton's method makes of `guess`, a neighbouring system's motion, in this system: an equilibrium or a periodic
/// motion, stable or not. Empty where it finds none, or one on which balls in contact would touch.
std::optional<Motion> refined_motion(const model::System& system, const Motion& guess, const StopFlag* stop = nullptr);
/// The same as motion_from() says, of states already refined.
Motion describe_equilibrium(const model::System& system, const Equilibrium& equilibrium);
Motion describe_orbit(const model::System& system, const PeriodicOrbit& orbit);
/// Balance under gravity with three balls or more: the motion along what gravity leaves of a continuum of balanced
/// states, from `state` next to it; deviations across it die out at `rate`.
Motion describe_creep(const model::System& system, const Eigen::VectorXd& state, double rate);

/// The system that the motion is one of.
model::System system_of(const model::Parameters& p, const Motion& motion);

/// The same motion, up to a shift in time, whole turns and exchange of equal balls. Orbits and equilibria are compared
/// as point sets to 1e-6, the others by their statistics.
bool same_motion(const model::Parameters& p, const Motion& a, const Motion& b);

/// The name that follows from its topology.
MotionName motion_name(const model::Parameters& p, const Motion& motion);

}  // namespace equipoise
