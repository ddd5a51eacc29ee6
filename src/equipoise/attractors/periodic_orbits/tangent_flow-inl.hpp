// One trajectory of a smooth system, with or without tangent vectors, by the adaptive integrator. Included once per CPU
// target.
#if defined(EQUIPOISE_PERIODIC_ORBITS_TANGENT_FLOW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_PERIODIC_ORBITS_TANGENT_FLOW_INL
#undef EQUIPOISE_PERIODIC_ORBITS_TANGENT_FLOW_INL
#else
#define EQUIPOISE_PERIODIC_ORBITS_TANGENT_FLOW_INL
#endif

#include <cmath>
#include <cstring>
#include <optional>

#include <Eigen/Core>

#include "equipoise/core/base/pack-inl.hpp"
#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// A number type of the equations: dual numbers (core/math/gradient.hpp over double) with their slopes side by side in
// registers. Without fused products and sums, results are bit-identical.
template <int slopes>
class WideDual {
 public:
  double value = 0.0;

  WideDual() = default;
  HWY_INLINE WideDual(double v) : value(v) {}

  // Takes the first `count` slopes; the others are 0.
  HWY_INLINE void take_slopes(const double* from, int count) {
    alignas(Pack) double all[room] = {};
    std::memcpy(all, from, sizeof(double) * static_cast<std::size_t>(count));
    for (int k = 0; k < packs; ++k) slope_[k] = Pack::load(all + k * lanes);
  }
  HWY_INLINE void put_slopes(double* to, int count) const {
    alignas(Pack) double all[room];
    for (int k = 0; k < packs; ++k) slope_[k].store(all + k * lanes);
    std::memcpy(to, all, sizeof(double) * static_cast<std::size_t>(count));
  }

  friend HWY_INLINE WideDual operator+(const WideDual& a, const WideDual& b) {
    return combine(a.value + b.value, [&](int k) HWY_ATTR { return a.slope_[k] + b.slope_[k]; });
  }
  friend HWY_INLINE WideDual operator-(const WideDual& a, const WideDual& b) {
    return combine(a.value - b.value, [&](int k) HWY_ATTR { return a.slope_[k] - b.slope_[k]; });
  }
  friend HWY_INLINE WideDual operator-(const WideDual& a) {
    return combine(-a.value, [&](int k) HWY_ATTR { return -a.slope_[k]; });
  }
  friend HWY_INLINE WideDual operator*(const WideDual& a, const WideDual& b) {
    const Pack of_a(a.value), of_b(b.value);
    return combine(a.value * b.value, [&](int k) HWY_ATTR { return a.slope_[k] * of_b + of_a * b.slope_[k]; });
  }
  friend HWY_INLINE WideDual operator/(const WideDual& a, const WideDual& b) {
    const double quotient = a.value / b.value;
    const Pack inverse(1.0 / b.value), whole(quotient);
    return combine(quotient, [&](int k) HWY_ATTR { return (a.slope_[k] - whole * b.slope_[k]) * inverse; });
  }
  friend HWY_INLINE WideDual multiply_add(const WideDual& a, const WideDual& b, const WideDual& c) { return a * b + c; }
  friend HWY_INLINE void sin_cos(const WideDual& a, WideDual& sine, WideDual& cosine) {
    const double s = std::sin(a.value), c = std::cos(a.value);
    const WideDual from = a;  // `a` may be one of the results
    const Pack along(c), back(-s);
    sine = combine(s, [&](int k) HWY_ATTR { return along * from.slope_[k]; });
    cosine = combine(c, [&](int k) HWY_ATTR { return back * from.slope_[k]; });
  }

 private:
  static constexpr int lanes = static_cast<int>(pack_lanes), packs = (slopes + lanes - 1) / lanes, room = packs * lanes;

  template <class Slope>
  static HWY_INLINE WideDual combine(double value, Slope&& slope_at) {
    WideDual result(value);
    for (int k = 0; k < packs; ++k) result.slope_[k] = slope_at(k);
    return result;
  }

  Pack slope_[packs] = {};
};

// Plain systems, with only the terms that they need; for this number of balls, or any number.
template <int room, Terms terms>
struct PlainSource {
  static constexpr int dimension = model::dimension(room);
  template <class T>
  using Flow = FreeFlow<T, room, terms>;
  template <class T>
  static Flow<T> make(const model::System& system, double psi) {
    return {system.parameters(), model::Segment{0.0, 0.0, psi, system.speed(), 0.0, false}};
  }
};
template <int room>
using Autonomous = PlainSource<room, Terms{false, false, false}>;
template <int room>
using AngleDependent = PlainSource<room, Terms{false, true, true}>;

// All others: with a motor or an off-centre race, or with a tilt.
template <bool tilt>
struct SmoothSource {
  // Of the largest state for that many balls.
  template <int balls>
  static constexpr int largest = SmoothFlow<double, balls, tilt>::dimension;
  static constexpr int dimension = largest<model::max_balls>;
  template <class T>
  using Flow = SmoothFlow<T, model::any_count, tilt>;
  template <class T>
  static Flow<T> make(const model::System& system, double psi) {
    return {system, psi};
  }
};

using GeneralSource = SmoothSource<false>;
using TiltSource = SmoothSource<true>;

// Calls f with the source of a smooth system's equations.
template <class F>
auto with_source(const model::System& system, F&& f) {
  constexpr int any = model::any_count;
  if (system.tilts()) return f(TiltSource{});
  if (!system.plain()) return f(GeneralSource{});
  return system.autonomous() ? f(Autonomous<any>{}) : f(AngleDependent<any>{});
}

// An observer of steps that looks at none.
inline constexpr auto unobserved = [](double, double, auto&&) {};

// Tangent vectors along a trajectory, as many as requested but at most `width`. Component (1 + vectors) i is variable
// i, the next `vectors` are its tangents.
template <class Source, int width>
class TangentFlow {
 public:
  using Number = WideDual<width>;
  static constexpr int most = Source::dimension, dimension = most * (1 + width);

  TangentFlow(const model::System& system, double psi, int vectors)
      : flow_(Source::template make<Number>(system, psi)), size_(system.dimension()), vectors_(vectors) {}

  // Not inlined: the integrator calls it in sixteen places.
  HWY_NOINLINE void operator()(double t, const double* y, double* dy) const {
    Number z[most], rate[most];
    const int stride = 1 + vectors_;
    for (int i = 0; i < size_; ++i) {
      z[i].value = y[stride * i];
      z[i].take_slopes(y + stride * i + 1, vectors_);
    }
    flow_(Number(t), z, rate);
    for (int i = 0; i < size_; ++i) {
      dy[stride * i] = rate[i].value;
      rate[i].put_slopes(dy + stride * i + 1, vectors_);
    }
  }

 private:
  typename Source::template Flow<Number> flow_;
  int size_, vectors_;
};

// For every `stride`-th component of the system's state.
template <int dimension>
ErrorScale<dimension> error_scale(const model::System& system, double tolerance, int stride = 1) {
  auto scale = error_scale<dimension>(system.parameters(), tolerance, stride);
  for (int i = model::dimension(system.balls()); i < system.dimension(); ++i) scale.floor[stride * i] = smallest_share;
  if (const int tilt = system.layout().tilt; tilt >= 0)
    for (int i = tilt; i < tilt + 4; ++i) scale.floor[stride * i] = scale.floor[0];
  for (const auto& angle : system.angles()) {
    scale.floor[stride * angle.place] = 1.0;
    scale.absolute[stride * angle.place] = scale.angle[stride * angle.place] = true;
  }
  return scale;
}

// With `vectors` tangents; those beyond `start`'s columns stay zero.
template <class Source, int width>
std::optional<TangentFlight> follow_at_width(const model::System& system, const Eigen::VectorXd& state,
                                             const Eigen::MatrixXd& start, int vectors, double duration,
                                             double tolerance, double psi, const StopFlag* stop) {
  using Flow = TangentFlow<Source, width>;
  const int size = system.dimension(), stride = 1 + vectors, count = static_cast<int>(start.cols());
  const Eigen::VectorXd unit = system.scale();
  auto scale = error_scale<Flow::dimension>(system, tolerance, stride);
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
  const auto status = integrator.advance(0.0, duration, y, unobserved, stop);
  if (status != IntegrationStatus::done || is_set(stop)) return std::nullopt;
  TangentFlight flight{Eigen::VectorXd(size), Eigen::MatrixXd(size, count)};
  for (int i = 0; i < size; ++i) {
    flight.end[i] = y[stride * i];
    for (int k = 0; k < count; ++k) flight.tangents(i, k) = y[stride * i + 1 + k];
  }
  return flight;
}

// Uses the first of the rising widths that holds the vectors: unused slopes cost as much as used ones.
template <class Source, int width, int... wider>
std::optional<TangentFlight> follow_within(const model::System& system, const Eigen::VectorXd& state,
                                           const Eigen::MatrixXd& start, int vectors, double duration, double tolerance,
                                           double psi, const StopFlag* stop) {
  if constexpr (sizeof...(wider) > 0)
    if (vectors > width)
      return follow_within<Source, wider...>(system, state, start, vectors, duration, tolerance, psi, stop);
  return follow_at_width<Source, width>(system, state, start, vectors, duration, tolerance, psi, stop);
}

// `widths`: for all tangents of the state. A few vectors, as for the leading Lyapunov exponents, cost less.
template <class Source, int... widths>
std::optional<TangentFlight> follow(const model::System& system, const Eigen::VectorXd& state,
                                    const Eigen::MatrixXd& start, double duration, double tolerance, double psi,
                                    const StopFlag* stop) {
  constexpr int few = 4;
  const int vectors = start.cols() <= few ? few : system.dimension();
  if constexpr (seldom_run)
    return follow_within<Source, few, Source::dimension>(system, state, start, vectors, duration, tolerance, psi, stop);
  else
    return follow_within<Source, few, widths...>(system, state, start, vectors, duration, tolerance, psi, stop);
}

// A trajectory without tangent vectors.
template <class Source>
class SmoothRun {
 public:
  using Flow = typename Source::template Flow<double>;

  // `psi`: the rotor's angle at time 0, if the state does not contain it.
  SmoothRun(const model::System& system, double psi, double tolerance)
      : flow_(Source::template make<double>(system, psi)),
        scale_(error_scale<Source::dimension>(system, tolerance)),
        size_(system.dimension()) {}

  const Flow& flow() const { return flow_; }
  // Takes `y` from time 0 to `duration`; the rest as AdaptiveIntegrator::advance().
  template <class Observe>
  IntegrationStatus advance(double duration, double* y, Observe&& observe, const StopFlag* stop = nullptr) const {
    AdaptiveIntegrator<Flow, Source::dimension> integrator(flow_, scale_, size_);
    return integrator.advance(0.0, duration, y, observe, stop);
  }

 private:
  Flow flow_;
  ErrorScale<Source::dimension> scale_;
  int size_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
