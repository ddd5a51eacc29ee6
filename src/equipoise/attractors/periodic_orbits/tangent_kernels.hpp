// Tangent vectors along trajectories, on the CPU target in use.
#pragma once

#include <optional>

#include "equipoise/attractors/periodic_orbits/variational.hpp"

namespace equipoise {

/// The arguments of follow_tangents() (attractors/periodic_orbits/variational.hpp).
struct TangentJob {
  const model::System& system;
  const Eigen::VectorXd& state;
  const Eigen::MatrixXd& vectors;
  double duration, tolerance, psi;
  const StopFlag* stop;
};

/// The same bits on every target.
std::optional<TangentFlight> run_tangents(const TangentJob& job);

}  // namespace equipoise
