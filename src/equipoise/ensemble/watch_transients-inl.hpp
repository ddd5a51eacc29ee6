// Observer of a lane block that gathers the statistics of transients: peaks, integrals, times above limits, and
// windows of time whose last one tells how a trajectory ends. Included once per CPU target.
#if defined(EQUIPOISE_ENSEMBLE_WATCH_TRANSIENTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_ENSEMBLE_WATCH_TRANSIENTS_INL
#undef EQUIPOISE_ENSEMBLE_WATCH_TRANSIENTS_INL
#else
#define EQUIPOISE_ENSEMBLE_WATCH_TRANSIENTS_INL
#endif

#include <cmath>
#include <cstddef>

#include "equipoise/ensemble/lane_block-inl.hpp"
#include "equipoise/ensemble/transient_step-inl.hpp"
#include "equipoise/ensemble/transient_table.hpp"
#include "equipoise/model/flow-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Hooks: see NoObserver in ensemble/lane_block-inl.hpp; step() returns the lanes whose window has just ended. The rows
// of the table go on growing from one task to the next. `windows`: off for tasks that no trajectory ends in.
template <int n, int groups, Terms terms, bool windows>
class WatchTransients {
 public:
  static constexpr int lanes = static_cast<int>(pack_lanes);

  WatchTransients(const LaneTask& task, TransientTable& table)
      : balancer_(*task.parameters),
        motion_(task.segment),
        table_(table),
        lambda_(task.parameters->eccentricity),
        displacement2_(table.settings.displacement * table.settings.displacement),
        settled2_(table.settings.settled * table.settings.settled),
        timed_(std::isfinite(table.settings.displacement)),
        turning_force_(!task.parameters->isotropic()) {
    for (int i = 0; i < n; ++i) mass_[i] = Pack(task.parameters->mass[i]);
  }

  void begin(int slot, std::size_t start, double t, const double* state) {
    const int g = slot / lanes, lane = slot % lanes;
    Pack z[model::dimension(n)];
    for (int i = 0; i < model::dimension(n); ++i) z[i] = Pack(state[i]);
    const Sample here = sample(Pack(t), z);
    element(from_[g].r2, lane) = element(here.r2, 0);
    element(from_[g].slope, lane) = element(here.slope, 0);
    element(from_[g].force2, lane) = element(here.force2, 0);
    element(from_[g].velocity2, lane) = element(here.velocity2, 0);
    const TransientSums& row = table_.rows[start];
    element(peak_[g], lane) = std::fmax(row.free_peak, element(here.r2, 0));
    element(force_peak_[g], lane) = std::fmax(row.force_peak, element(here.force2, 0));
    element(force_integral_[g], lane) = row.force_integral;
    element(time_above_[g], lane) = row.time_above;
    element(last_above_[g], lane) = row.last_above;
    if constexpr (windows) {
      element(from_unbalance_[g], lane) = element(unbalance(z), 0);
      restart(slot, t);
    }
  }

  HWY_INLINE void stage(int row, int g, const Pack* z) {
    if (row == transient::first_stage)
      for (int i = 0; i < 4; ++i) first_[g][i] = z[i];
    if (row == transient::second_stage)
      for (int i = 0; i < 4; ++i) second_[g][i] = z[i];
  }

  HWY_INLINE unsigned step(int g, unsigned active, Mask accepted, Pack t, Pack h, const Pack* z) {
    const Pack begin = t - h;
    const Sample last = sample(t, z);
    const auto samples = samples_of(g, begin, h, last);
    const transient::SquaredRadiusOfStep<Pack> r2(samples, h);
    const auto force2 = transient::Cubic<Pack>::through(samples.force2);

    keep(accepted, multiply_add(h, force2.integral(), force_integral_[g]), force_integral_[g]);
    keep(accepted, transient::raised(force_peak_[g], force2), force_peak_[g]);
    Pack peak = peak_[g];
    if constexpr (windows) {
      Pack window_peak = window_peak_[g];
      transient::raise(peak, window_peak, r2);
      keep(accepted, window_peak, window_peak_[g]);
    } else {
      peak = transient::raised(peak, r2);
    }
    keep(accepted, peak, peak_[g]);
    watch_limits(g, accepted, r2, begin, h);
    unsigned full = 0;
    if constexpr (windows) full = add_to_windows(g, active, accepted, t, h, samples, z);
    keep(accepted, last.r2, from_[g].r2);
    keep(accepted, last.slope, from_[g].slope);
    keep(accepted, last.force2, from_[g].force2);
    keep(accepted, last.velocity2, from_[g].velocity2);
    return full;
  }

  // Begins the window of a lane anew at the trajectory's present time: what went before is not of its end.
  void restart(int slot, double t) {
    open(slot, t, element(from_[slot / lanes].r2, slot % lanes));
    closed_[slot] = {};
  }

  // Whether r stayed below settings.settled throughout the window that has just ended.
  bool settled(int slot) const { return closed_[slot].peak <= element(settled2_, 0); }

  void end(int slot, std::size_t start, double t) {
    const int g = slot / lanes, lane = slot % lanes;
    TransientSums& row = table_.rows[start];
    row.end = t;
    row.free_peak = element(peak_[g], lane);
    row.force_peak = element(force_peak_[g], lane);
    row.force_integral = element(force_integral_[g], lane);
    row.time_above = element(time_above_[g], lane);
    row.last_above = element(last_above_[g], lane);
    if constexpr (!windows) return;
    const Window& before = closed_[slot];  // empty unless it ends where the open one begins
    row.window_length = before.length + (t - element(window_begin_[g], lane));
    row.window_peak = std::fmax(before.peak, element(window_peak_[g], lane));
    row.window_velocity = before.velocity + element(window_velocity_[g], lane);
    row.window_unbalance = before.unbalance + element(window_unbalance_[g], lane);
    if (row.window_length > 0.0) return;
    row.window_length = 1.0;  // lost in its first step: the state there is all there is
    row.window_velocity = element(from_[g].velocity2, lane);
    row.window_unbalance = element(from_unbalance_[g], lane);
  }

 private:
  struct Sample {
    Pack r2, slope, force2, velocity2;
  };
  struct Window {
    double length = 0.0, peak = 0.0, velocity = 0.0, unbalance = 0.0;
  };

  static HWY_INLINE void keep(Mask accepted, Pack value, Pack& kept) { kept = select(accepted, value, kept); }

  HWY_INLINE Sample sample(Pack t, const Pack* z) const {
    using namespace model::index;
    // An isotropic support's force does not ask where the rotor points.
    const Vector2<Pack> f = balancer_.bearing_force(
        turning_force_ ? motion_.at(t) : RotorMotion<Pack>{Pack(0.0), Pack(0.0), Pack(0.0), Pack(1.0)}, z);
    return {z[x] * z[x] + z[y] * z[y], Pack(2.0) * (z[x] * z[u] + z[y] * z[v]), f.x * f.x + f.y * f.y,
            z[u] * z[u] + z[v] * z[v]};
  }

  HWY_INLINE transient::StepSamples<Pack> samples_of(int g, Pack begin, Pack h, const Sample& last) const {
    const Sample at[4] = {from_[g], sample(multiply_add(Pack(transient::node1), h, begin), first_[g]),
                          sample(multiply_add(Pack(transient::node2), h, begin), second_[g]), last};
    transient::StepSamples<Pack> s;
    for (int k = 0; k < 4; ++k) {
      s.r2[k] = at[k].r2;
      s.slope[k] = at[k].slope;
      s.force2[k] = at[k].force2;
      s.velocity2[k] = at[k].velocity2;
    }
    return s;
  }

  HWY_INLINE void watch_limits(int g, Mask accepted, const transient::SquaredRadiusOfStep<Pack>& r2, Pack begin,
                               Pack h) {
    if (timed_) {
      Pack total = time_above_[g], unused(0.0);
      transient::time_above(r2, displacement2_, begin, h, total, unused);
      keep(accepted, total, time_above_[g]);
    }
    if (table_.settings.watches_settling()) {
      Pack unused(0.0), last = last_above_[g];
      transient::time_above(r2, settled2_, begin, h, unused, last);
      keep(accepted, last, last_above_[g]);
    }
  }

  HWY_INLINE Pack unbalance(const Pack* z) const {
    Pack ux = lambda_, uy(0.0);
    for (int i = 0; i < n; ++i) {
      Pack sine, cosine;
      sin_cos(z[4 + i], sine, cosine);
      ux = multiply_add(mass_[i], cosine, ux);
      uy = multiply_add(mass_[i], sine, uy);
    }
    return square_root(ux * ux + uy * uy);
  }

  HWY_INLINE unsigned add_to_windows(int g, unsigned active, Mask accepted, Pack t, Pack h,
                                     const transient::StepSamples<Pack>& samples, const Pack* z) {
    const Pack velocity = transient::Cubic<Pack>::through(samples.velocity2).integral();
    keep(accepted, multiply_add(h, velocity, window_velocity_[g]), window_velocity_[g]);
    const Pack now = unbalance(z);
    keep(accepted, multiply_add(Pack(0.5) * h, from_unbalance_[g] + now, window_unbalance_[g]), window_unbalance_[g]);
    keep(accepted, now, from_unbalance_[g]);
    const Pack end = window_begin_[g] + Pack(table_.settings.window);
    const unsigned full = active & lane_bits(accepted) & ~lane_bits(t < end);
    if (full) close(g, full, t, samples.r2[3]);
    return full;
  }

  HWY_NOINLINE void close(int g, unsigned full, Pack t, Pack r2) {
    for (int lane = 0; lane < lanes; ++lane) {
      if (!(full & (1u << lane))) continue;
      const int slot = g * lanes + lane;
      const double now = element(t, lane);
      closed_[slot] = {now - element(window_begin_[g], lane), element(window_peak_[g], lane),
                       element(window_velocity_[g], lane), element(window_unbalance_[g], lane)};
      open(slot, now, element(r2, lane));
    }
  }

  void open(int slot, double t, double r2) {
    const int g = slot / lanes, lane = slot % lanes;
    element(window_begin_[g], lane) = t;
    element(window_peak_[g], lane) = r2;
    element(window_velocity_[g], lane) = 0.0;
    element(window_unbalance_[g], lane) = 0.0;
  }

  static double& element(Pack& p, int lane) { return reinterpret_cast<double*>(&p)[lane]; }
  static double element(const Pack& p, int lane) { return reinterpret_cast<const double*>(&p)[lane]; }

  const BallBalancer<Pack, n, terms> balancer_;
  const SegmentMotion<Pack, terms> motion_;
  TransientTable& table_;
  const Pack lambda_, displacement2_, settled2_;
  Pack mass_[n];
  const bool timed_, turning_force_;
  Sample from_[groups];  // where the step begins
  Pack first_[groups][4], second_[groups][4];
  Pack peak_[groups], force_peak_[groups], force_integral_[groups], time_above_[groups], last_above_[groups];
  Pack from_unbalance_[groups], window_begin_[groups], window_peak_[groups], window_velocity_[groups],
      window_unbalance_[groups];
  Window closed_[groups * lanes];
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
