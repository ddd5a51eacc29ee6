// The constant-speed system and its variational equations as systems for the adaptive integrator.
#include "equipoise/orbits/variational.hpp"

#include <algorithm>
#include <type_traits>

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

// As many tangent vectors along a trajectory as asked for, `width` at most. Component (1 + vectors) i is variable i,
// the next `vectors` are its tangents.
template <int width, kernels::Terms terms>
class TangentFlow {
 public:
  static constexpr int most = model::dimension(model::max_balls), dimension = most * (1 + width);

  TangentFlow(const model::Parameters& p, const model::Segment& segment, int vectors)
      : flow_(p, segment), vectors_(vectors) {}

  // Not inlined: the integrator calls it in sixteen places.
  HWY_NOINLINE void operator()(double t, const double* y, double* dy) const {
    Dual<width> z[most], rate[most];
    const int stride = 1 + vectors_;
    for (int i = 0; i < flow_.size(); ++i) {
      z[i].value = y[stride * i];
      std::copy_n(y + stride * i + 1, vectors_, z[i].slope);
    }
    flow_(Dual<width>(t), z, rate);
    for (int i = 0; i < flow_.size(); ++i) {
      dy[stride * i] = rate[i].value;
      std::copy_n(rate[i].slope, vectors_, dy + stride * i + 1);
    }
  }

 private:
  kernels::FreeFlow<Dual<width>, model::any_count, terms> flow_;
  int vectors_;
};

// With `vectors` tangents, of which those beyond `start`'s columns stay zero.
template <int width, kernels::Terms terms>
std::optional<TangentFlight> follow(const model::Parameters& p, const model::Segment& segment, const VectorXd& state,
                                    const MatrixXd& start, int vectors, double duration, double tolerance) {
  using Flow = TangentFlow<width, terms>;
  const int size = model::dimension(p.balls), stride = 1 + vectors;
  const int count = static_cast<int>(start.cols());
  const VectorXd unit = state_scale(p);
  kernels::ErrorScale<Flow::dimension> scale;
  scale.tolerance = tolerance;
  kernels::set_state_scale(p, stride, scale);
  double y[Flow::dimension] = {};
  for (int i = 0; i < size; ++i) {
    y[stride * i] = state[i];
    for (int k = 0; k < vectors; ++k) {
      // Columns beyond `count` stay zero; their scale only has to be positive.
      const double length = k < count ? start.col(k).cwiseQuotient(unit).template lpNorm<Eigen::Infinity>() : 0.0;
      scale.floor[stride * i + 1 + k] = unit[i] * (length > 0.0 ? length : 1.0);
      if (k < count) y[stride * i + 1 + k] = start(i, k);
    }
  }
  const Flow flow(p, segment, vectors);
  kernels::AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale, size * stride);
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
                                             const MatrixXd& start, double duration, double tolerance, double psi) {
  // Few vectors, as for the leading Lyapunov exponents, are carried at less cost.
  constexpr int few = 4;
  const model::Segment segment = constant_speed(speed, psi);
  const int size = model::dimension(p.balls), vectors = start.cols() <= few ? few : size;
  const auto run = [&](auto width) {
    return model::is_strobed(p) ? follow<width, strobed>(p, segment, state, start, vectors, duration, tolerance)
                                : follow<width, autonomous>(p, segment, state, start, vectors, duration, tolerance);
  };
  // All at a width little above their number: slopes that are not used cost as much as those that are.
  if (vectors <= few) return run(std::integral_constant<int, few>{});
  if (vectors <= model::dimension(2)) return run(std::integral_constant<int, model::dimension(2)>{});
  if (vectors <= model::dimension(4)) return run(std::integral_constant<int, model::dimension(4)>{});
  if (vectors <= model::dimension(6)) return run(std::integral_constant<int, model::dimension(6)>{});
  return run(std::integral_constant<int, model::dimension(8)>{});
}

std::optional<TangentFlight> follow_derivative(const model::Parameters& p, double speed, const VectorXd& state,
                                               double duration, double tolerance, double psi) {
  return follow_tangents(p, speed, state, MatrixXd::Identity(state.size(), state.size()), duration, tolerance, psi);
}

namespace {

template <kernels::Terms terms>
std::optional<VectorXd> advance(const model::Parameters& p, const model::Segment& segment, const VectorXd& state,
                                double duration) {
  using Flow = kernels::FreeFlow<double, model::any_count, terms>;
  kernels::ErrorScale<Flow::dimension> scale;
  scale.tolerance = 1e-12;
  kernels::set_state_scale(p, 1, scale);
  const Flow flow(p, segment);
  kernels::AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale, flow.size());
  VectorXd end = state;
  const auto status = integrator.advance(0.0, duration, end.data(), [](double, double, auto&&) {});
  if (status != IntegrationStatus::done) return std::nullopt;
  return end;
}

}  // namespace

std::optional<VectorXd> advance_state(const model::Parameters& p, double speed, const VectorXd& state, double duration,
                                      double psi) {
  const model::Segment segment = constant_speed(speed, psi);
  return model::is_strobed(p) ? advance<strobed>(p, segment, state, duration)
                              : advance<autonomous>(p, segment, state, duration);
}

}  // namespace equipoise
