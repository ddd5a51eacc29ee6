// The constant-speed system and its variational equations as systems for the adaptive integrator.
#include "equipoise/orbits/variational.hpp"

#include <algorithm>

#include "equipoise/integrate/adaptive-inl.hpp"
#include "equipoise/math/dual.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/flow-inl.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/orbits/orbit.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr kernels::Terms autonomous{false, false, false}, strobed{false, true, true};

model::Segment constant_speed(double speed, double psi) { return {0.0, 0.0, psi, speed, 0.0, false}; }

// `width` tangent vectors along a trajectory. Component (1 + width) i is variable i, the next `width` are its tangents.
template <int n, int width, kernels::Terms terms>
class TangentFlow {
 public:
  static constexpr int size = model::dimension(n), dimension = size * (1 + width);

  TangentFlow(const model::Parameters& p, const model::Segment& segment) : flow_(p, segment) {}

  // Not inlined: the integrator calls it in sixteen places.
  HWY_NOINLINE void operator()(double t, const double* y, double* dy) const {
    Dual<width> z[size], rate[size];
    for (int i = 0; i < size; ++i) {
      z[i].value = y[(1 + width) * i];
      std::copy_n(y + (1 + width) * i + 1, width, z[i].slope);
    }
    flow_(Dual<width>(t), z, rate);
    for (int i = 0; i < size; ++i) {
      dy[(1 + width) * i] = rate[i].value;
      std::copy_n(rate[i].slope, width, dy + (1 + width) * i + 1);
    }
  }

 private:
  kernels::FreeFlow<Dual<width>, n, terms> flow_;
};

template <int n, int width, kernels::Terms terms>
std::optional<TangentFlight> follow(const model::Parameters& p, const model::Segment& segment, const VectorXd& state,
                                    const MatrixXd& vectors, double duration, double tolerance) {
  using Flow = TangentFlow<n, width, terms>;
  constexpr int size = Flow::size, stride = 1 + width;
  const int count = static_cast<int>(vectors.cols());
  const VectorXd unit = state_scale(p);
  kernels::ErrorScale<Flow::dimension> scale;
  scale.tolerance = tolerance;
  kernels::set_state_scale<n>(p, stride, scale);
  double y[Flow::dimension] = {};
  for (int i = 0; i < size; ++i) {
    y[stride * i] = state[i];
    for (int k = 0; k < width; ++k) {
      // Columns beyond `count` stay zero; their scale only has to be positive.
      const double length = k < count ? vectors.col(k).cwiseQuotient(unit).template lpNorm<Eigen::Infinity>() : 0.0;
      scale.floor[stride * i + 1 + k] = unit[i] * (length > 0.0 ? length : 1.0);
      if (k < count) y[stride * i + 1 + k] = vectors(i, k);
    }
  }
  const Flow flow(p, segment);
  kernels::AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale);
  const auto status = integrator.advance(0.0, duration, y, [](double, double, auto&&) {});
  if (status != IntegrationStatus::done) return std::nullopt;
  TangentFlight flight{VectorXd(size), MatrixXd(size, count)};
  for (int i = 0; i < size; ++i) {
    flight.end[i] = y[stride * i];
    for (int k = 0; k < count; ++k) flight.tangents(i, k) = y[stride * i + 1 + k];
  }
  return flight;
}

}  // namespace

VectorXd state_scale(const model::Parameters& p) {
  VectorXd scale = VectorXd::Ones(model::dimension(p.balls));
  scale.head(4).setConstant(p.eccentricity + p.total_mass());
  return scale;
}

std::optional<TangentFlight> follow_tangents(const model::Parameters& p, double speed, const VectorXd& state,
                                             const MatrixXd& vectors, double duration, double tolerance, double psi) {
  // Few vectors, as for the leading Lyapunov exponents, are carried at less cost.
  constexpr int few = 4;
  const model::Segment segment = constant_speed(speed, psi);
  return model::with_ball_count(p.balls, [&](auto n) {
    constexpr int all = model::dimension(n);
    if (model::is_strobed(p))
      return vectors.cols() <= few ? follow<n, few, strobed>(p, segment, state, vectors, duration, tolerance)
                                   : follow<n, all, strobed>(p, segment, state, vectors, duration, tolerance);
    return vectors.cols() <= few ? follow<n, few, autonomous>(p, segment, state, vectors, duration, tolerance)
                                 : follow<n, all, autonomous>(p, segment, state, vectors, duration, tolerance);
  });
}

std::optional<TangentFlight> follow_derivative(const model::Parameters& p, double speed, const VectorXd& state,
                                               double duration, double tolerance, double psi) {
  return follow_tangents(p, speed, state, MatrixXd::Identity(state.size(), state.size()), duration, tolerance, psi);
}

namespace {

template <int n, kernels::Terms terms>
std::optional<VectorXd> advance(const model::Parameters& p, const model::Segment& segment, const VectorXd& state,
                                double duration) {
  using Flow = kernels::FreeFlow<double, n, terms>;
  kernels::ErrorScale<Flow::dimension> scale;
  scale.tolerance = 1e-12;
  kernels::set_state_scale<n>(p, 1, scale);
  const Flow flow(p, segment);
  kernels::AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale);
  VectorXd end = state;
  const auto status = integrator.advance(0.0, duration, end.data(), [](double, double, auto&&) {});
  if (status != IntegrationStatus::done) return std::nullopt;
  return end;
}

}  // namespace

std::optional<VectorXd> advance_state(const model::Parameters& p, double speed, const VectorXd& state, double duration,
                                      double psi) {
  const model::Segment segment = constant_speed(speed, psi);
  return model::with_ball_count(p.balls, [&](auto n) -> std::optional<VectorXd> {
    return model::is_strobed(p) ? advance<n, strobed>(p, segment, state, duration)
                                : advance<n, autonomous>(p, segment, state, duration);
  });
}

}  // namespace equipoise
