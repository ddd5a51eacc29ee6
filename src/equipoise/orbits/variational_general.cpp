// Trajectories and tangents of systems with a motor or an off-centre race.
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/smooth_flow-inl.hpp"
#include "equipoise/orbits/tangent_flow-inl.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;

// Of the largest state for that many balls.
template <int balls>
constexpr int largest = kernels::SmoothFlow<double, balls>::dimension;

struct GeneralFlow {
  template <class T>
  using Flow = kernels::SmoothFlow<T, model::any_count>;
  static constexpr int dimension = largest<model::max_balls>;
  template <class T>
  static Flow<T> make(const model::System& system, double psi) {
    return {system, psi};
  }
};
}  // namespace

std::optional<TangentFlight> follow_tangents_generally(const model::System& system, const Eigen::VectorXd& state,
                                                       const Eigen::MatrixXd& start, double duration, double tolerance,
                                                       double psi, const StopFlag* stop) {
  return kernels::follow<GeneralFlow, largest<2>, largest<4>, largest<8>>(system, state, start, duration, tolerance,
                                                                          psi, stop);
}

std::optional<Eigen::VectorXd> advance_generally(const model::System& system, const Eigen::VectorXd& state,
                                                 double duration, double psi, double tolerance) {
  return kernels::advance<GeneralFlow>(system, state, duration, psi, tolerance);
}

}  // namespace equipoise
