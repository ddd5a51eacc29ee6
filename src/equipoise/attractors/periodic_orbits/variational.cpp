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
  constexpr int any = model::any_count;
  if (system.tilts()) return kernels::advance<kernels::TiltSource>(system, state, duration, psi, tolerance);
  if (!system.plain()) return kernels::advance<kernels::GeneralSource>(system, state, duration, psi, tolerance);
  return system.autonomous() ? kernels::advance<kernels::Autonomous<any>>(system, state, duration, psi, tolerance)
                             : kernels::advance<kernels::AngleDependent<any>>(system, state, duration, psi, tolerance);
}

}  // namespace equipoise
