// Trajectories of the constant-speed system together with tangent vectors carried along them (variational equations:
// the model's equations on dual numbers).
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// Size of each state variable that counts as one when variables of different units are compared: lambda + sum mu_i
/// (what r is of the order of) for the rotor's, 1 for the balls'.
Eigen::VectorXd state_scale(const model::Parameters& p);

struct TangentFlight {
  Eigen::VectorXd end;       ///< the state where the trajectory ends
  Eigen::MatrixXd tangents;  ///< the images of the given vectors, columns in the same order
};

/// Follows `state` and small deviations from it, the columns of `vectors` (any number up to the state's size, any
/// length), for `duration` >= 0, by adaptive DOP853. Errors a step: `tolerance` times the size of each state variable
/// (angles: of one radian); for tangents the same relative to the larger of their own size and the given vector's.
/// `psi`: the rotor's angle at the beginning; it matters with anisotropic supports or gravity only.
/// Empty if the integration fails.
std::optional<TangentFlight> follow_tangents(const model::Parameters& p, double speed, const Eigen::VectorXd& state,
                                             const Eigen::MatrixXd& vectors, double duration, double tolerance,
                                             double psi = 0.0);

/// The same with the identity: `tangents` is then the derivative of the end with respect to the start.
std::optional<TangentFlight> follow_derivative(const model::Parameters& p, double speed, const Eigen::VectorXd& state,
                                               double duration, double tolerance, double psi = 0.0);

}  // namespace equipoise
