// Trajectories of smooth systems with tangent vectors carried along (variational equations: the model's equations on
// dual numbers).
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

// Throughout, states are those of machine/model/system.hpp. `psi` is the rotor's angle at the beginning, which matters
// only with a stroboscopic section. Results are empty if the integration fails or `stop` is set.

struct TangentFlight {
  Eigen::VectorXd end;       ///< the trajectory's last state
  Eigen::MatrixXd tangents;  ///< the images of the given vectors, columns in the same order
};

/// Follows `state` and small deviations from it, the columns of `vectors` (any number up to the state's size, any
/// length), for `duration` >= 0, by adaptive DOP853. Errors a step: `tolerance` times the size of each state variable
/// (angles: of one radian); for tangents relative to the larger of their own size and the given vector's. The same bits
/// on every CPU target.
std::optional<TangentFlight> follow_tangents(const model::System& system, const Eigen::VectorXd& state,
                                             const Eigen::MatrixXd& vectors, double duration, double tolerance,
                                             double psi = 0.0, const StopFlag* stop = nullptr);

/// The same with the identity: `tangents` is the derivative of the end with respect to the start.
std::optional<TangentFlight> follow_derivative(const model::System& system, const Eigen::VectorXd& state,
                                               double duration, double tolerance, double psi = 0.0,
                                               const StopFlag* stop = nullptr);

/// One pass of multiple shooting: follow_derivative() for `time` from every node. Empty if one fails or leaves all
/// bounds.
std::vector<TangentFlight> follow_arcs(const model::System& system, const std::vector<Eigen::VectorXd>& nodes,
                                       double time, double tolerance, const StopFlag* stop = nullptr);
/// The product of their derivatives: of the last one's end by the first node.
Eigen::MatrixXd monodromy(const std::vector<TangentFlight>& arcs);
/// A derivative of states by states, both in units of `unit`.
inline Eigen::MatrixXd in_units(const Eigen::MatrixXd& derivative, const Eigen::VectorXd& unit) {
  return unit.cwiseInverse().asDiagonal() * derivative * unit.asDiagonal();
}

/// The state a time `duration` >= 0 later (adaptive DOP853).
std::optional<Eigen::VectorXd> advance_state(const model::System& system, const Eigen::VectorXd& state, double duration,
                                             double psi = 0.0, double tolerance = 1e-12);

}  // namespace equipoise
