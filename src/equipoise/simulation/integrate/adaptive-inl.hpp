// One trajectory in double precision with step control and dense output: the accurate, unhurried integrator behind
// `simulate` and the clamped spin-up. Ensembles use simulation/batch/batch_block-inl.hpp.
// This room: tableaus, stepper, step control, the clamped phase, events.
#if defined(EQUIPOISE_INTEGRATE_ADAPTIVE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_INTEGRATE_ADAPTIVE_INL
#undef EQUIPOISE_INTEGRATE_ADAPTIVE_INL
#else
#define EQUIPOISE_INTEGRATE_ADAPTIVE_INL
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/simulation/integrate/dop853-inl.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/results/types/status.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Error allowed in component i of a step: tolerance * max(floor[i], |y_i|), or tolerance * floor[i] where
// `absolute[i]` (angles, whose size has no meaning).
template <int dimension>
struct ErrorScale {
  double tolerance = 1e-12;
  std::array<double, dimension> floor{};
  std::array<bool, dimension> absolute{};
  std::array<bool, dimension> angle{};  // may grow without being a sign of divergence
};

// Below this share of a variable's size its error is absolute.
inline constexpr double smallest_share = 0.01;

// The scale of a state with free balls, for every `stride`-th component: relative, but absolute for angles and small
// values.
template <int dimension>
ErrorScale<dimension> error_scale(const model::Parameters& p, double tolerance, int stride = 1) {
  ErrorScale<dimension> scale{.tolerance = tolerance};
  for (int i = 0; i < model::dimension(p.balls); ++i) {
    const bool rotor = i < 4, angle = !rotor && i < 4 + p.balls;
    scale.floor[stride * i] = rotor ? smallest_share * p.motion_scale() : angle ? 1.0 : smallest_share;
    scale.absolute[stride * i] = scale.angle[stride * i] = angle;
  }
  return scale;
}

// `System`: callable (t, y, dy) with `size` components, `dimension` at most, smooth over every interval passed to
// advance().
template <class System, int dimension>
class AdaptiveIntegrator {
 public:
  AdaptiveIntegrator(const System& system, const ErrorScale<dimension>& scale, int size = dimension)
      : system_(system), scale_(scale), size_(size) {}

  // Integrates `y` from `begin` to exactly `end`. After each accepted step calls
  // observe(t_old, t_new, state_at), where state_at(t, out) is the dense output within the step. Returns early, as
  // `done`, once `stop` is set. If observe returns a time before t_new, integration ends there, with a step of that
  // length: dense output would be less accurate.
  template <class Observe>
  IntegrationStatus advance(double begin, double end, double* y, Observe&& observe, const StopFlag* stop = nullptr) {
    double t = begin, previous_error = 1.0;
    reached_ = begin;
    double h = first_step(begin, end, y);
    bool rejected = false;
    for (long steps = 0; t < end && !is_set(stop); ++steps) {
      if (steps == max_steps) return IntegrationStatus::failed;
      const bool last = t + 1.0000001 * h >= end;
      if (last) h = end - t;
      double y_new[dimension], error5[dimension], error3[dimension];
      dop853::evaluate_stages(system_, t, h, y, k_, size_);
      dop853::step_end(h, y, k_, y_new, error5, error3, size_);
      double inverse_scale[dimension];
      for (int i = 0; i < size_; ++i) {
        const double size = scale_.absolute[i] ? 0.0 : std::max(std::fabs(y[i]), std::fabs(y_new[i]));
        inverse_scale[i] = 1.0 / (scale_.tolerance * std::max(scale_.floor[i], size));
      }
      const double error = std::sqrt(dop853::squared_error<double, dimension>(h, error5, error3, inverse_scale, size_));
      if (!(error <= 1.0)) {  // not-a-number is a rejection too
        rejected = true;
        h *= error < 1e10 ? std::max(0.2, 0.9 * std::pow(error, -0.125)) : 0.2;
        if (!(h > 16 * std::numeric_limits<double>::epsilon() * std::max(1e-300, std::fabs(t))))
          return IntegrationStatus::failed;
        continue;
      }
      const double t_new = last ? end : t + h;
      system_(t_new, static_cast<const double*>(y_new), k_[12]);
      if constexpr (std::is_same_v<decltype(observe(t, t_new, StateAt{*this, t, h, y, y_new})), double>) {
        const double until = observe(t, t_new, StateAt{*this, t, h, y, y_new});
        if (until < t_new) {
          finish_at(t, until, y);
          return IntegrationStatus::done;
        }
      } else {
        observe(t, t_new, StateAt{*this, t, h, y, y_new});
      }
      const double growth = 0.9 * std::pow(std::max(error, 1e-10), -0.0875) * std::pow(previous_error, 0.05);
      previous_error = std::max(error, 1e-4);
      std::copy(y_new, y_new + size_, y);
      std::copy(k_[12], k_[12] + size_, k_[0]);
      reached_ = t = t_new;
      h *= std::clamp(growth, 0.2, rejected ? 1.0 : 6.0);
      rejected = false;
      for (int i = 0; i < size_; ++i)
        if (!(std::fabs(y[i]) < (scale_.angle[i] ? angle_limit : divergence_limit))) return IntegrationStatus::diverged;
    }
    return IntegrationStatus::done;
  }

  // The time that advance() reached.
  double reached() const { return reached_; }

 private:
  static constexpr long max_steps = 100'000'000;
  static constexpr double angle_limit = 1e12;  // its last digit is then a hundredth of a degree

  // Dense output within the step just accepted; the three stages it needs are evaluated at the first call.
  struct StateAt {
    AdaptiveIntegrator& owner;
    double t, h;
    const double *y, *y_new;
    bool ready = false;
    double rows[7][dimension];

    StateAt(AdaptiveIntegrator& o, double t0, double step, const double* from, const double* to)
        : owner(o), t(t0), h(step), y(from), y_new(to) {}

    void operator()(double time, double* out) {
      if (!ready) prepare();
      dop853::dense_state<double, dimension>((time - t) / h, y, rows, out, owner.size_);
    }

    // Cubic Hermite interpolation, for rough checks: it needs no evaluation of the system.
    void roughly(double time, double* out) const {
      const double s = (time - t) / h, r = 1.0 - s;
      for (int i = 0; i < owner.size_; ++i)
        out[i] = r * r * ((1.0 + 2.0 * s) * y[i] + s * h * owner.k_[0][i]) +
                 s * s * ((1.0 + 2.0 * r) * y_new[i] - r * h * owner.k_[12][i]);
    }

    void prepare() {
      dop853::prepare_dense<double, dimension>(owner.system_, t, h, y, y_new, owner.k_, rows, owner.size_);
      ready = true;
    }
  };

  // The state at `until` within the step just tried from t; overwrites the step's stages other than the first.
  void finish_at(double t, double until, double* y) {
    reached_ = until;
    if (!(until > t)) return;
    double end[dimension], error5[dimension], error3[dimension];
    dop853::evaluate_stages(system_, t, until - t, y, k_, size_);
    dop853::step_end(until - t, y, k_, end, error5, error3, size_);
    std::copy(end, end + size_, y);
  }

  // A step over which the solution, moving at its present rate, changes by a hundredth of its size.
  double first_step(double begin, double end, const double* y) {
    system_(begin, y, k_[0]);
    double h = end - begin;
    for (int i = 0; i < size_; ++i) {
      const double size = std::max(scale_.absolute[i] ? 0.0 : std::fabs(y[i]), scale_.floor[i]);
      h = std::min(h, 0.01 * size / std::max(std::fabs(k_[0][i]), 1e-300));
    }
    return std::max(h, 1e-12 * (end - begin));
  }

  const System& system_;
  ErrorScale<dimension> scale_;
  int size_;
  double reached_ = 0.0;
  double k_[dop853::tableau::dense_stages][dimension];
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
