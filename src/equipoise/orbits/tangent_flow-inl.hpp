// One trajectory of a flow of the model, with and without tangent vectors, for the adaptive integrator. A flow's source
// tells its largest dimension and makes it over a number type: variational.cpp, variational_general.cpp.
#pragma once

#include <algorithm>
#include <optional>

#include <Eigen/Dense>

#include "equipoise/integrate/adaptive-inl.hpp"
#include "equipoise/math/dual.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/orbits/variational.hpp"

namespace equipoise {
namespace HWY_NAMESPACE {

// `width` tangent vectors along a trajectory. Component (1 + width) i is variable i, the next `width` are its tangents.
template <class Source, int width>
class TangentFlow {
 public:
  static constexpr int size = Source::dimension, dimension = size * (1 + width);

  TangentFlow(const model::System& system, double psi) : flow_(Source::template make<Dual<width>>(system, psi)) {}

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
  typename Source::template Flow<Dual<width>> flow_;
};

// For every `stride`-th component, those beyond the system's too: they rest at 0.
template <int n, int size, int dimension>
void set_system_scale(const model::System& system, int stride, ErrorScale<dimension>& scale) {
  set_state_scale<n>(system.parameters(), stride, scale);
  constexpr double smallest_share = 0.01;  // as there
  for (int i = model::dimension(n); i < size; ++i) scale.floor[stride * i] = smallest_share;
  for (const auto& angle : system.angles()) {
    scale.floor[stride * angle.place] = 1.0;
    scale.absolute[stride * angle.place] = scale.angle[stride * angle.place] = true;
  }
}

template <class Source, int width>
std::optional<TangentFlight> follow(const model::System& system, const Eigen::VectorXd& state,
                                    const Eigen::MatrixXd& vectors, double duration, double tolerance, double psi) {
  using Flow = TangentFlow<Source, width>;
  constexpr int stride = 1 + width;
  const int size = system.dimension(), count = static_cast<int>(vectors.cols());
  const Eigen::VectorXd unit = system.scale();
  ErrorScale<Flow::dimension> scale;
  scale.tolerance = tolerance;
  scale.floor.fill(1.0);  // of what stays zero; it only has to be positive
  set_system_scale<Source::balls, Flow::size>(system, stride, scale);
  double y[Flow::dimension] = {};
  for (int k = 0; k < width; ++k) {
    const double length = k < count ? vectors.col(k).cwiseQuotient(unit).template lpNorm<Eigen::Infinity>() : 0.0;
    for (int i = 0; i < size; ++i) {
      y[stride * i] = state[i];
      scale.floor[stride * i + 1 + k] = unit[i] * (length > 0.0 ? length : 1.0);
      if (k < count) y[stride * i + 1 + k] = vectors(i, k);
    }
  }
  const Flow flow(system, psi);
  AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale);
  const auto status = integrator.advance(0.0, duration, y, [](double, double, auto&&) {});
  if (status != IntegrationStatus::done) return std::nullopt;
  TangentFlight flight{Eigen::VectorXd(size), Eigen::MatrixXd(size, count)};
  for (int i = 0; i < size; ++i) {
    flight.end[i] = y[stride * i];
    for (int k = 0; k < count; ++k) flight.tangents(i, k) = y[stride * i + 1 + k];
  }
  return flight;
}

template <class Source>
std::optional<Eigen::VectorXd> advance(const model::System& system, const Eigen::VectorXd& state, double duration,
                                       double psi) {
  using Flow = typename Source::template Flow<double>;
  constexpr int size = Source::dimension;
  ErrorScale<size> scale;
  scale.tolerance = 1e-12;
  set_system_scale<Source::balls, size>(system, 1, scale);
  const Flow flow = Source::template make<double>(system, psi);
  AdaptiveIntegrator<Flow, size> integrator(flow, scale);
  double y[size] = {};
  std::copy_n(state.data(), state.size(), y);
  const auto status = integrator.advance(0.0, duration, y, [](double, double, auto&&) {});
  if (status != IntegrationStatus::done) return std::nullopt;
  return Eigen::Map<Eigen::VectorXd>(y, state.size());
}

}  // namespace HWY_NAMESPACE

// Systems that are not plain (model/system.hpp).
std::optional<TangentFlight> follow_tangents_generally(const model::System& system, const Eigen::VectorXd& state,
                                                       const Eigen::MatrixXd& vectors, double duration,
                                                       double tolerance, double psi);
std::optional<Eigen::VectorXd> advance_generally(const model::System& system, const Eigen::VectorXd& state,
                                                 double duration, double psi);

}  // namespace equipoise
