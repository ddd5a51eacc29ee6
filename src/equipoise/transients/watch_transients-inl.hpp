// Observer of a lane block that gathers the statistics of transients: peaks, integrals, times above limits, and
// windows of time whose last one tells how a trajectory ends. Included once per CPU target.
#if defined(EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#undef EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#else
#define EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#endif

#include <array>
#include <cmath>
#include <cstddef>

#include "equipoise/lanes/lane_block-inl.hpp"
#include "equipoise/model/flow-inl.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/model/unbalance-inl.hpp"
#include "equipoise/transients/transient_step-inl.hpp"
#include "equipoise/transients/transient_table.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Hooks: see NoObserver in lanes/lane_block-inl.hpp; step() returns the lanes whose window has just ended. The rows
// of the table go on growing from one task to the next. `windows`: off for tasks that no trajectory ends in.
template <int room, int groups, Terms terms, bool windows>
class WatchTransients {
 public:
  static constexpr int lanes = static_cast<int>(pack_lanes);

  WatchTransients(const LaneTask& task, TransientTable& table)
      : n(task.parameters->balls),
        balancer_(*task.parameters),
        motion_(task.segment),
        table_(table),
        lambda_(task.parameters->eccentricity),
        displacement2_(table.settings.displacement * table.settings.displacement),
        settled2_(table.settings.settled * table.settings.settled),
        timed_(std::isfinite(table.settings.displacement)),
        turning_(task.general()),
        sag_(model::static_sag(*task.parameters)) {
    for (int i = 0; i < n; ++i) mass_[i] = Pack(task.parameters->mass[i]);
  }

  void begin(int slot, std::size_t start, double t, const double* state) {
    const int g = slot / lanes, lane = slot % lanes;
    Pack z[model::dimension(room)];
    for (int i = 0; i < n.size(); ++i) z[i] = Pack(state[i]);
    const Sample here = sample(Pack(t), z);
    element(from_[g].r2, lane) = element(here.r2, 0);
    element(from_[g].slope, lane) = element(here.slope, 0);
    element(from_[g].force2, lane) = element(here.force2, 0);
    element(from_[g].velocity2, lane) = element(here.velocity2, 0);
    const TransientSums& row = table_.rows[start];
    element(peak_[g], lane) = std::fmax(row.free_peak, element(here.r2, 0));
    element(force_peak_[g], lane) = std::fmax(row.force_peak, element(here.force2, 0));
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
    if constexpr (windows) full = add_to_windows(g, active, accepted, t, h, samples, force2.integral(), z);
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
    count_[slot] = 0;
  }

  // Whether a trajectory restarted when it was decided for `attractor` may end with the window that has just ended.
  bool seen_enough(int slot, int attractor) const {
    const auto& [last, before, first] = closed_[slot];
    return equipoise::seen_enough(table_.settings, table_.end_of(attractor), {before, first}, last, count_[slot],
                                  element(peak_[slot / lanes], slot % lanes));
  }

  void end(int slot, std::size_t start, double t) {
    const int g = slot / lanes, lane = slot % lanes;
    TransientSums& row = table_.rows[start];
    row.end = t;
    row.free_peak = element(peak_[g], lane);
    row.force_peak = element(force_peak_[g], lane);
    row.time_above = element(time_above_[g], lane);
    row.last_above = element(last_above_[g], lane);
    if constexpr (!windows) return;
    // The window that has ended last is empty unless the open one follows on it.
    row.window = last_windows(closed_[slot][0], open_window(slot, t));
    if (row.window.length > 0.0) return;
    const Sample& only = from_[g];  // lost in its first step: the state there is all there is
    row.window = {1.0, element(only.r2, lane), element(only.force2, lane), element(only.velocity2, lane),
                  element(from_unbalance_[g], lane)};
  }

 private:
  struct Sample {
    Pack r2, slope, force2, velocity2;
  };

  static HWY_INLINE void keep(Mask accepted, Pack value, Pack& kept) { kept = select(accepted, value, kept); }

  HWY_INLINE Sample sample(Pack t, const Pack* z) const {
    using namespace model::index;
    // The force of isotropic supports does not ask where the rotor points, and only gravity lets it sag.
    const RotorMotion<Pack> rotor =
        turning_ ? motion_.at(t) : RotorMotion<Pack>{Pack(0.0), Pack(0.0), Pack(0.0), Pack(1.0)};
    const Vector2<Pack> f = balancer_.bearing_force(rotor, z);
    Pack rx = z[x], ry = z[y];
    if constexpr (terms.gravity) {
      rx = rx - sag_ * rotor.sin_psi;
      ry = ry - sag_ * rotor.cos_psi;
    }
    return {rx * rx + ry * ry, Pack(2.0) * (rx * z[u] + ry * z[v]), f.x * f.x + f.y * f.y, z[u] * z[u] + z[v] * z[v]};
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
    const Vector2<Pack> all = sum_of_unbalances({lambda_, Pack(0.0)}, n, mass_, z + 4);
    return square_root(all.x * all.x + all.y * all.y);
  }

  HWY_INLINE unsigned add_to_windows(int g, unsigned active, Mask accepted, Pack t, Pack h,
                                     const transient::StepSamples<Pack>& samples, Pack force, const Pack* z) {
    keep(accepted, multiply_add(h, force, window_force_[g]), window_force_[g]);
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
      ++count_[slot];
      closed_[slot] = {open_window(slot, now), closed_[slot][0], closed_[slot][1]};
      open(slot, now, element(r2, lane));
    }
  }

  // What the open window of a lane holds at time `t`.
  TransientWindow open_window(int slot, double t) const {
    const int g = slot / lanes, lane = slot % lanes;
    return {t - element(window_begin_[g], lane), element(window_peak_[g], lane), element(window_force_[g], lane),
            element(window_velocity_[g], lane), element(window_unbalance_[g], lane)};
  }

  void open(int slot, double t, double r2) {
    const int g = slot / lanes, lane = slot % lanes;
    element(window_begin_[g], lane) = t;
    element(window_peak_[g], lane) = r2;
    element(window_force_[g], lane) = 0.0;
    element(window_velocity_[g], lane) = 0.0;
    element(window_unbalance_[g], lane) = 0.0;
  }

  static double& element(Pack& p, int lane) { return reinterpret_cast<double*>(&p)[lane]; }
  static double element(const Pack& p, int lane) { return reinterpret_cast<const double*>(&p)[lane]; }

  const model::BallCount<room> n;
  const BallBalancer<Pack, room, terms> balancer_;
  const SegmentMotion<Pack, terms> motion_;
  TransientTable& table_;
  const Pack lambda_, displacement2_, settled2_;
  Pack mass_[room];
  const bool timed_, turning_;
  const Pack sag_;
  Sample from_[groups];  // where the step begins
  Pack first_[groups][4], second_[groups][4];
  Pack peak_[groups], force_peak_[groups], time_above_[groups], last_above_[groups];
  Pack from_unbalance_[groups], window_begin_[groups], window_peak_[groups], window_force_[groups],
      window_velocity_[groups], window_unbalance_[groups];
  std::array<TransientWindow, 3> closed_[groups * lanes];  // the last ones, the latest first
  int count_[groups * lanes];                              // since restart()
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
