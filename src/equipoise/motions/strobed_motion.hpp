// From a trajectory of a rotor with anisotropic supports or gravity to the motion it settles on.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/model/parameters.hpp"
#include "equipoise/motions/motion.hpp"

namespace equipoise {

/// motion_from() for such rotors; `state` holds at a strobe (psi = 0, orbits/stroboscopic.hpp), speed is not 0.
std::optional<Motion> strobed_motion_from(const model::Parameters& p, double speed, const Eigen::VectorXd& state,
                                          double patience, const StopFlag* stop = nullptr);

/// The same for an orbit already refined (refine_strobed()).
Motion describe_strobed(const model::Parameters& p, double speed, const PeriodicOrbit& orbit);

/// Balance under gravity with three balls or more: the motion along what gravity leaves of a continuum of balanced
/// states, from `state` next to it; deviations across it die out at `rate`.
Motion describe_creep(const model::Parameters& p, double speed, const Eigen::VectorXd& state, double rate);

}  // namespace equipoise
