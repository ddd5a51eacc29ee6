// Chooses the equations that a trajectory is followed by.
#include "equipoise/attractors/periodic_orbits/variational.hpp"

#include <utility>

#include "equipoise/attractors/periodic_orbits/tangent_flow-inl.hpp"

namespace equipoise {

namespace kernels = HWY_NAMESPACE;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::optional<TangentFlight> follow_derivative(const model::System& system, const VectorXd& state, double duration,
                                               double tolerance, double psi, const StopFlag* stop) {
  return follow_tangents(system, state, MatrixXd::Identity(state.size(), state.size()), duration, tolerance, psi, stop);
}

std::vector<TangentFlight> follow_arcs(const model::System& system, const std::vector<VectorXd>& nodes, double time,
                                       double tolerance, const StopFlag* stop) {
  std::vector<TangentFlight> arcs;
  for (const VectorXd& node : nodes) {
    auto arc = follow_derivative(system, node, time, tolerance, 0.0, stop);
    if (!arc || !arc->end.allFinite()) return {};
    arcs.push_back(*std::move(arc));
  }
  return arcs;
}

MatrixXd monodromy(const std::vector<TangentFlight>& arcs) {
  MatrixXd all = arcs.front().tangents;
  for (std::size_t k = 1; k < arcs.size(); ++k) all = arcs[k].tangents * all;
  return all;
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
