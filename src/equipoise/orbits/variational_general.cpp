// Trajectories and tangents of systems with a motor or an off-centre race.
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/smooth_flow-inl.hpp"
#include "equipoise/orbits/tangent_flow-inl.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;

template <int n>
struct GeneralFlow {
  template <class T>
  using Flow = kernels::SmoothFlow<T, n>;
  static constexpr int balls = n, dimension = Flow<double>::dimension;
  template <class T>
  static Flow<T> make(const model::System& system, double psi) {
    return {system, psi};
  }
};
}  // namespace

std::optional<TangentFlight> follow_tangents_generally(const model::System& system, const Eigen::VectorXd& state,
                                                       const Eigen::MatrixXd& vectors, double duration,
                                                       double tolerance, double psi) {
  return model::with_ball_count(system.balls(), [&](auto n) {
    using Flow = GeneralFlow<n>;
    return kernels::follow<Flow, Flow::dimension>(system, state, vectors, duration, tolerance, psi);
  });
}

std::optional<Eigen::VectorXd> advance_generally(const model::System& system, const Eigen::VectorXd& state,
                                                 double duration, double psi) {
  return model::with_ball_count(system.balls(),
                                [&](auto n) { return kernels::advance<GeneralFlow<n>>(system, state, duration, psi); });
}

}  // namespace equipoise
