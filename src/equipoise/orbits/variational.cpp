// Trajectories and tangents of plain systems, which have terms only for what they are.
#include "equipoise/orbits/variational.hpp"

#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/flow-inl.hpp"
#include "equipoise/orbits/tangent_flow-inl.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;
using Eigen::MatrixXd;
using Eigen::VectorXd;

template <kernels::Terms terms>
struct PlainFlow {
  static constexpr int dimension = model::dimension(model::max_balls);
  template <class T>
  using Flow = kernels::FreeFlow<T, model::any_count, terms>;
  template <class T>
  static Flow<T> make(const model::System& system, double psi) {
    return {system.parameters(), model::Segment{0.0, 0.0, psi, system.speed(), 0.0, false}};
  }
};
using Autonomous = PlainFlow<kernels::Terms{false, false, false}>;
using Strobed = PlainFlow<kernels::Terms{false, true, true}>;

template <class Source>
std::optional<TangentFlight> follow_plain(const model::System& system, const VectorXd& state, const MatrixXd& start,
                                          double duration, double tolerance, double psi, const StopFlag* stop) {
  using model::dimension;
  return kernels::follow<Source, dimension(2), dimension(4), dimension(6), dimension(8)>(system, state, start, duration,
                                                                                         tolerance, psi, stop);
}

}  // namespace

std::optional<TangentFlight> follow_tangents(const model::System& system, const VectorXd& state, const MatrixXd& start,
                                             double duration, double tolerance, double psi, const StopFlag* stop) {
  if (!system.plain()) return follow_tangents_generally(system, state, start, duration, tolerance, psi, stop);
  return system.autonomous() ? follow_plain<Autonomous>(system, state, start, duration, tolerance, psi, stop)
                             : follow_plain<Strobed>(system, state, start, duration, tolerance, psi, stop);
}

std::optional<TangentFlight> follow_derivative(const model::System& system, const VectorXd& state, double duration,
                                               double tolerance, double psi, const StopFlag* stop) {
  return follow_tangents(system, state, MatrixXd::Identity(state.size(), state.size()), duration, tolerance, psi, stop);
}

std::optional<VectorXd> advance_state(const model::System& system, const VectorXd& state, double duration, double psi,
                                      double tolerance) {
  if (!system.plain()) return advance_generally(system, state, duration, psi, tolerance);
  return system.autonomous() ? kernels::advance<Autonomous>(system, state, duration, psi, tolerance)
                             : kernels::advance<Strobed>(system, state, duration, psi, tolerance);
}

}  // namespace equipoise
