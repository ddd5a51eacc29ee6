// Samples of a lane's windows of time: extremes and integrals of r^2, ball rates, the rotor's turning. Included once
// per CPU target.
#if defined(EQUIPOISE_CLASSIFICATION_WINDOW_SAMPLES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_CLASSIFICATION_WINDOW_SAMPLES_INL
#undef EQUIPOISE_CLASSIFICATION_WINDOW_SAMPLES_INL
#else
#define EQUIPOISE_CLASSIFICATION_WINDOW_SAMPLES_INL
#endif

#include <type_traits>

#include "equipoise/core/base/pack-inl.hpp"
#include "equipoise/simulation/batch/batch_task.hpp"
#include "equipoise/simulation/batch/batch_watch-inl.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"
#include "equipoise/simulation/rule/window_features.hpp"
#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/model/ball_count.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// For a tilting rotor, the slopes count next to x and y: r is 0 only if it neither vibrates nor tilts.
//
// Windows are sampled at two stages inside each step and at its end (at 1/3, 0.6 and 1 of it, at most 0.4 apart). So
// every motion is seen at least eight times a period at the steps that the tolerance allows;
// tests/equivalence/window_sampling_test.cpp measures it.
template <int room, int groups, BatchKind kind>
class WindowSamples {
 public:
  static constexpr bool angle_known = kind != BatchKind::plain, smooth = kind >= BatchKind::smooth,
                        tilts = kind == BatchKind::tilting;
  static constexpr int lanes = static_cast<int>(pack_lanes);

  WindowSamples(const BatchTask& task, const ClassificationRule& rule)
      : n(task.held ? 1 : task.parameters->balls),
        rule_(rule),
        psi_place_(task.layout().psi),
        speed_place_(task.layout().speed),
        tilt_place_(task.layout().tilt) {
    for (int g = 0; g < groups; ++g) {
      segment_speed_[g] = Pack(task.segment.speed);
      segment_begin_[g] = Pack(task.segment.begin);
      segment_psi_[g] = Pack(task.segment.psi);
      sag_[g] = Pack(rule.sag);
    }
  }

  void take_rotor(int g, int lane, const OwnRotor& rotor) {
    element(segment_speed_[g], lane) = rotor.segment.speed;
    element(segment_begin_[g], lane) = rotor.segment.begin;
    element(segment_psi_[g], lane) = rotor.segment.psi;
    element(sag_[g], lane) = model::static_sag(rotor.system.parameters());
  }

  HWY_INLINE void stage(int row, int g, const Pack* z) {
    if (row == first_sampled_stage) take(first_[g], z);
    if (row == second_sampled_stage) take(second_[g], z);
  }

  // Adds the samples of an accepted step to the windows of its lanes.
  HWY_INLINE void gather(int g, Mask accepted, [[maybe_unused]] Pack t, Pack h, const Pack* z) {
    Taken last;
    take(last, z);
    if constexpr (angle_known) {
      measure(g, first_[g], t - Pack(2.0 / 3) * h);
      measure(g, second_[g], t - Pack(0.4) * h);
      measure(g, last, t);
    }
    const Pack low = minimum(minimum(first_[g].r2, second_[g].r2), last.r2);
    const Pack high = maximum(maximum(first_[g].r2, second_[g].r2), last.r2);
    r2_min_[g] = select(accepted, minimum(r2_min_[g], low), r2_min_[g]);
    r2_max_[g] = select(accepted, maximum(r2_max_[g], high), r2_max_[g]);
    const Pack integral = multiply_add(h * Pack(1.0 / 3), first_[g].r2 + second_[g].r2 + last.r2, r2_integral_[g]);
    r2_integral_[g] = select(accepted, integral, r2_integral_[g]);
    for (int i = 0; i < n; ++i) {
      const Pack slow = minimum(minimum(first_[g].q[i], second_[g].q[i]), last.q[i]);
      const Pack fast = maximum(maximum(first_[g].q[i], second_[g].q[i]), last.q[i]);
      q_min_[g][i] = select(accepted, minimum(q_min_[g][i], slow), q_min_[g][i]);
      q_max_[g][i] = select(accepted, maximum(q_max_[g][i], fast), q_max_[g][i]);
    }
    if constexpr (smooth)
      if (speed_place_ >= 0) gather_speed(g, accepted, h, last.speed);
  }

  void open(int g, int lane, double t, const double* phi) {
    element(window_end_[g], lane) = t + 0.5 * rule_.window;
    element(r2_min_[g], lane) = 1e300;
    element(r2_max_[g], lane) = 0.0;
    element(r2_integral_[g], lane) = 0.0;
    for (int i = 0; i < n; ++i) {
      element(phi_start_[g][i], lane) = phi[i];
      element(q_min_[g][i], lane) = 1e300;
      element(q_max_[g][i], lane) = -1e300;
    }
    if constexpr (smooth) {
      element(rotor_turned_[g], lane) = 0.0;
      element(speed_min_[g], lane) = 1e300;
      element(speed_max_[g], lane) = -1e300;
    }
  }

  HWY_INLINE unsigned ended(int g, Pack t) const { return ~lane_bits(t < window_end_[g]); }

  // Sums of a half window that ends with the ball angles `phi`.
  WindowSums sums(int g, int lane, double now, const double* phi) const {
    WindowSums result;
    result.duration = now - (element(window_end_[g], lane) - 0.5 * rule_.window);
    result.r2_min = element(r2_min_[g], lane);
    result.r2_max = element(r2_max_[g], lane);
    result.r2_integral = element(r2_integral_[g], lane);
    for (int i = 0; i < n; ++i) {
      result.turned[i] = phi[i] - element(phi_start_[g][i], lane);
      result.q_min[i] = element(q_min_[g][i], lane);
      result.q_max[i] = element(q_max_[g][i], lane);
    }
    if constexpr (smooth)
      if (speed_place_ >= 0) {
        result.rotor_turned = element(rotor_turned_[g], lane);
        result.speed_min = element(speed_min_[g], lane);
        result.speed_max = element(speed_max_[g], lane);
      }
    return result;
  }

 private:
  struct Sample {
    Pack r2, q[room];
  };
  struct PlacedSample : Sample {
    Pack x, y;
  };
  struct SmoothSample : PlacedSample {
    Pack psi, speed;
  };
  struct TiltSample : SmoothSample {
    Pack slope2;
  };
  using Taken = std::conditional_t<
      tilts, TiltSample,
      std::conditional_t<smooth, SmoothSample, std::conditional_t<angle_known, PlacedSample, Sample>>>;

  HWY_INLINE void take(Taken& sample, const Pack* z) const {
    if constexpr (smooth) {
      if (psi_place_ >= 0) sample.psi = z[psi_place_];
      sample.speed = speed_place_ >= 0 ? z[speed_place_] : Pack(0.0);
    }
    if constexpr (tilts) {
      const Pack &sx = z[tilt_place_], &sy = z[tilt_place_ + 1];
      sample.slope2 = sx * sx + sy * sy;
    }
    if constexpr (angle_known) {
      sample.x = z[0];
      sample.y = z[1];
    } else {
      sample.r2 = z[0] * z[0] + z[1] * z[1];
    }
    for (int i = 0; i < n; ++i) sample.q[i] = z[4 + n + i];
  }

  // r^2 of a sample taken at time t, from the sag.
  HWY_INLINE void measure(int g, Taken& sample, Pack t) const {
    Pack sine(0.0), cosine(1.0);
    Pack psi = multiply_add(segment_speed_[g], t - segment_begin_[g], segment_psi_[g]);
    if constexpr (smooth)
      if (psi_place_ >= 0) psi = sample.psi;
    if (!smooth || rule_.sag != 0.0) sin_cos(psi, sine, cosine);
    const Pack x = sample.x - sag_[g] * sine, y = sample.y - sag_[g] * cosine;
    sample.r2 = x * x + y * y;
    if constexpr (tilts) sample.r2 = sample.r2 + sample.slope2;
  }

  // psi' like a ball's rate; psi by Radau quadrature, whose nodes are among the samples.
  HWY_INLINE void gather_speed(int g, Mask accepted, Pack h, Pack last) {
    const Pack &first = first_[g].speed, &second = second_[g].speed;
    const Pack slow = minimum(minimum(first, second), last), fast = maximum(maximum(first, second), last);
    speed_min_[g] = select(accepted, minimum(speed_min_[g], slow), speed_min_[g]);
    speed_max_[g] = select(accepted, maximum(speed_max_[g], fast), speed_max_[g]);
    const Pack turned = multiply_add(h, Pack(0.75) * first + Pack(0.25) * last, rotor_turned_[g]);
    rotor_turned_[g] = select(accepted, turned, rotor_turned_[g]);
  }

  const model::BallCount<room> n;
  const ClassificationRule& rule_;
  const int psi_place_, speed_place_, tilt_place_;
  Taken first_[groups], second_[groups];
  Pack r2_min_[groups], r2_max_[groups], r2_integral_[groups], window_end_[groups];
  Pack q_min_[groups][room], q_max_[groups][room], phi_start_[groups][room];
  Pack rotor_turned_[groups], speed_min_[groups], speed_max_[groups];
  Pack segment_speed_[groups], segment_begin_[groups], segment_psi_[groups], sag_[groups];  // each lane's
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
