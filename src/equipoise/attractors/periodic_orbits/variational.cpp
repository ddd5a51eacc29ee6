// Chooses the equations that a trajectory is followed by.
#include "equipoise/attractors/periodic_orbits/variational.hpp"

#include "equipoise/attractors/periodic_orbits/tangent_flow-inl.hpp"

namespace equipoise {

namespace kernels = HWY_NAMESPACE;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::optional<TangentFlight> follow_derivative(const model::System& system, const VectorXd& state, double duration,
                                               double tolerance, double psi, const StopFlag* stop) {
  return follow_tangents(system, state, MatrixXd::Identity(state.size(), state.size()), duration, tolerance, psi, stop);
}

std::optional<VectorXd> advance_state(const model::System& system, const VectorXd& state, double duration, double psi,
                                      double tolerance) {
  VectorXd end = state;
  const IntegrationStatus status = kernels::with_source(system, [&]<class Source>(Source) {
    return kernels::SmoothRun<Source>(system, psi, tolerance).advance(duration, end.data(), kernels::unobserved);
  });
  return status == IntegrationStatus::done ? std::optional(end) : std::nullopt;
}

}  // namespace equipoise
