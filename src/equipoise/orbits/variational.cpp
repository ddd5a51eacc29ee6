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

constexpr kernels::Terms autonomous{false, false, false}, strobed{false, true, true};

template <int n, kernels::Terms terms>
struct PlainFlow {
  static constexpr int balls = n, dimension = model::dimension(n);
  template <class T>
  using Flow = kernels::FreeFlow<T, n, terms>;
  template <class T>
  static Flow<T> make(const model::System& system, double psi) {
    return {system.parameters(), model::Segment{0.0, 0.0, psi, system.speed(), 0.0, false}};
  }
};

}  // namespace

std::optional<TangentFlight> follow_tangents(const model::System& system, const VectorXd& state,
                                             const MatrixXd& vectors, double duration, double tolerance, double psi) {
  if (!system.plain()) return follow_tangents_generally(system, state, vectors, duration, tolerance, psi);
  // Few vectors, as for the leading Lyapunov exponents, are carried at less cost.
  constexpr int few = 4;
  return model::with_ball_count(system.balls(), [&](auto n) {
    constexpr int all = model::dimension(n);
    using Free = PlainFlow<n, autonomous>;
    using Strobed = PlainFlow<n, strobed>;
    if (system.autonomous())
      return vectors.cols() <= few ? kernels::follow<Free, few>(system, state, vectors, duration, tolerance, psi)
                                   : kernels::follow<Free, all>(system, state, vectors, duration, tolerance, psi);
    return vectors.cols() <= few ? kernels::follow<Strobed, few>(system, state, vectors, duration, tolerance, psi)
                                 : kernels::follow<Strobed, all>(system, state, vectors, duration, tolerance, psi);
  });
}

std::optional<TangentFlight> follow_derivative(const model::System& system, const VectorXd& state, double duration,
                                               double tolerance, double psi) {
  return follow_tangents(system, state, MatrixXd::Identity(state.size(), state.size()), duration, tolerance, psi);
}

std::optional<VectorXd> advance_state(const model::System& system, const VectorXd& state, double duration, double psi) {
  if (!system.plain()) return advance_generally(system, state, duration, psi);
  return model::with_ball_count(system.balls(), [&](auto n) {
    return system.autonomous() ? kernels::advance<PlainFlow<n, autonomous>>(system, state, duration, psi)
                               : kernels::advance<PlainFlow<n, strobed>>(system, state, duration, psi);
  });
}

}  // namespace equipoise
