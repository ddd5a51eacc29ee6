// One trajectory of a flow of the model, with and without tangent vectors, for the adaptive integrator. A flow's source
// tells its largest dimension and makes it over a number type: variational.cpp, variational_general.cpp.
#pragma once

#include <algorithm>
#include <optional>

#include <Eigen/Core>

#include "equipoise/integrate/adaptive-inl.hpp"
#include "equipoise/math/dual.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/orbits/variational.hpp"

namespace equipoise {
namespace HWY_NAMESPACE {

// As many tangent vectors along a trajectory as asked for, `width` at most. Component (1 + vectors) i is variable i,
// the next `vectors` are its tangents.
template <class Source, int width>
class TangentFlow {
 public:
  static constexpr int most = Source::dimension, dimension = most * (1 + width);

  TangentFlow(const model::System& system, double psi, int vectors)
      : flow_(Source::template make<Dual<width>>(system, psi)), size_(system.dimension()), vectors_(vectors) {}

  // Not inlined: the integrator calls it in sixteen places.
  HWY_NOINLINE void operator()(double t, const double* y, double* dy) const {
    Dual<width> z[most], rate[most];
    const int stride = 1 + vectors_;
    for (int i = 0; i < size_; ++i) {
      z[i].value = y[stride * i];
      std::copy_n(y + stride * i + 1, vectors_, z[i].slope);
    }
    flow_(Dual<width>(t), z, rate);
    for (int i = 0; i < size_; ++i) {
      dy[stride * i] = rate[i].value;
      std::copy_n(rate[i].slope, vectors_, dy + stride * i + 1);
    }
  }

 private:
  typename Source::template Flow<Dual<width>> flow_;
  int size_, vectors_;
};

// For every `stride`-th component of the system's state.
template <int dimension>
void set_system_scale(const model::System& system, int stride, ErrorScale<dimension>& scale) {
  set_state_scale(system.parameters(), stride, scale);
  for (int i = model::dimension(system.balls()); i < system.dimension(); ++i) scale.floor[stride * i] = smallest_share;
  for (const auto& angle : system.angles()) {
    scale.floor[stride * angle.place] = 1.0;
    scale.absolute[stride * angle.place] = scale.angle[stride * angle.place] = true;
  }
}

// With `vectors` tangents, of which those beyond `start`'s columns stay zero.
template <class Source, int width>
std::optional<TangentFlight> follow_at_width(const model::System& system, const Eigen::VectorXd& state,
                                             const Eigen::MatrixXd& start, int vectors, double duration,
                                             double tolerance, double psi, const StopFlag* stop) {
  using Flow = TangentFlow<Source, width>;
  const int size = system.dimension(), stride = 1 + vectors, count = static_cast<int>(start.cols());
  const Eigen::VectorXd unit = system.scale();
  ErrorScale<Flow::dimension> scale;
  scale.tolerance = tolerance;
  set_system_scale(system, stride, scale);
  double y[Flow::dimension] = {};
  for (int i = 0; i < size; ++i) y[stride * i] = state[i];
  for (int k = 0; k < vectors; ++k) {
    // Columns beyond `count` stay zero; their scale only has to be positive.
    const double length = k < count ? start.col(k).cwiseQuotient(unit).template lpNorm<Eigen::Infinity>() : 0.0;
    for (int i = 0; i < size; ++i) {
      scale.floor[stride * i + 1 + k] = unit[i] * (length > 0.0 ? length : 1.0);
      if (k < count) y[stride * i + 1 + k] = start(i, k);
    }
  }
  const Flow flow(system, psi, vectors);
  AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale, size * stride);
  const auto status = integrator.advance(
      0.0, duration, y, [](double, double, auto&&) {}, stop);
  if (status != IntegrationStatus::done || is_set(stop)) return std::nullopt;
  TangentFlight flight{Eigen::VectorXd(size), Eigen::MatrixXd(size, count)};
  for (int i = 0; i < size; ++i) {
    flight.end[i] = y[stride * i];
    for (int k = 0; k < count; ++k) flight.tangents(i, k) = y[stride * i + 1 + k];
  }
  return flight;
}

// At the first of the rising widths that holds the vectors: slopes that are not used cost as much as those that are.
template <class Source, int width, int... wider>
std::optional<TangentFlight> follow_within(const model::System& system, const Eigen::VectorXd& state,
                                           const Eigen::MatrixXd& start, int vectors, double duration, double tolerance,
                                           double psi, const StopFlag* stop) {
  if constexpr (sizeof...(wider) > 0)
    if (vectors > width)
      return follow_within<Source, wider...>(system, state, start, vectors, duration, tolerance, psi, stop);
  return follow_at_width<Source, width>(system, state, start, vectors, duration, tolerance, psi, stop);
}

// `widths`: for all tangents of the state. Few, as for the leading Lyapunov exponents, are carried at less cost.
template <class Source, int... widths>
std::optional<TangentFlight> follow(const model::System& system, const Eigen::VectorXd& state,
                                    const Eigen::MatrixXd& start, double duration, double tolerance, double psi,
                                    const StopFlag* stop) {
  constexpr int few = 4;
  const int vectors = start.cols() <= few ? few : system.dimension();
  return follow_within<Source, few, widths...>(system, state, start, vectors, duration, tolerance, psi, stop);
}

template <class Source>
std::optional<Eigen::VectorXd> advance(const model::System& system, const Eigen::VectorXd& state, double duration,
                                       double psi, double tolerance) {
  using Flow = typename Source::template Flow<double>;
  ErrorScale<Source::dimension> scale;
  scale.tolerance = tolerance;
  set_system_scale(system, 1, scale);
  const Flow flow = Source::template make<double>(system, psi);
  AdaptiveIntegrator<Flow, Source::dimension> integrator(flow, scale, system.dimension());
  Eigen::VectorXd end = state;
  const auto status = integrator.advance(0.0, duration, end.data(), [](double, double, auto&&) {});
  if (status != IntegrationStatus::done) return std::nullopt;
  return end;
}

}  // namespace HWY_NAMESPACE

// Systems that are not plain (model/system.hpp).
std::optional<TangentFlight> follow_tangents_generally(const model::System& system, const Eigen::VectorXd& state,
                                                       const Eigen::MatrixXd& start, double duration, double tolerance,
                                                       double psi, const StopFlag* stop);
std::optional<Eigen::VectorXd> advance_generally(const model::System& system, const Eigen::VectorXd& state,
                                                 double duration, double psi, double tolerance);

}  // namespace equipoise
