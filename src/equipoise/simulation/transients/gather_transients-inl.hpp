// The sums of transients, for SIMD lanes and for double: peaks, integrals, times above limits, and windows of time, the
// last of which gives the figures at the end. Included once per CPU target.
#if defined(EQUIPOISE_TRANSIENTS_GATHER_TRANSIENTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_TRANSIENTS_GATHER_TRANSIENTS_INL
#undef EQUIPOISE_TRANSIENTS_GATHER_TRANSIENTS_INL
#else
#define EQUIPOISE_TRANSIENTS_GATHER_TRANSIENTS_INL
#endif

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "equipoise/simulation/transients/transient_step-inl.hpp"
#include "equipoise/results/types/transient_table.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {
namespace transient {

template <class T>
struct Limits {
  explicit Limits(const TransientSettings& s)
      : timed(std::isfinite(s.displacement)),
        settling(s.watches_settling()),
        working(s.work != WorkSource::none),
        by_direction(s.by_direction),
        displacement2(s.displacement * s.displacement),
        settled2(s.settled * s.settled),
        window(s.window) {}

  // Lane `lane` gets the limits of `from`, which must have the same flags.
  void take_lane(const Limits& from, int lane) {
    take_lane_of(*this, from, lane, &Limits::displacement2, &Limits::settled2, &Limits::window);
  }

  bool timed, settling, working, by_direction;
  T displacement2, settled2, window;
};

// As many parts of TurningUnbalance as are watched: two, or four of a tilting rotor.
template <class T, int parts>
struct Unbalances {
  T part[parts];
};

// What limits apply to: r at the place watched, or at the other one if that is further out.
struct Alone {
  template <class Curve>
  HWY_INLINE const Curve& operator()(const Curve& r2) const {
    return r2;
  }
};
template <class T>
struct Beside {
  const SquaredRadiusOfStep<T>& other;
  HWY_INLINE LargerOfStep<T> operator()(const SquaredRadiusOfStep<T>& r2) const { return {r2, other}; }
};

// As many trajectories as T has lanes, each at its own time.
template <class T, int parts = 4>
class GatherTransients {
 public:
  static constexpr int lanes = lane_count<T>;
  using Turning = Unbalances<T, parts>;
  using Flags = decltype(T() < T());

  // Goes on from the sums of a trajectory; `free`: its balls have been released.
  void load(int lane, const TransientSums& row, bool free = true) {
    const RadialPeak& peak = free ? row.free_peak : row.clamped_peak;
    element(peak_, lane) = peak.square;
    element(peak_time_, lane) = peak.time;
    element(peak_speed_, lane) = peak.speed;
    element(force_peak_, lane) = row.force_peak;
    element(dynamic_peak_, lane) = row.dynamic_peak;
    element(time_above_, lane) = row.time_above;
    element(last_above_, lane) = row.last_above;
    work_before_[lane] = row.work;
    known_work_[lane].reset();
  }

  // From the loaded sums to `here`, the next sight of the motion at t, the power is taken as linear.
  void resume(int lane, const TransientSums& row, double t, const Sample<double>& here) {
    const DriveWork& work = work_before_[lane];
    element(work_, lane) =
        work.begun ? work.piece - work.stored + 0.5 * (work.power + here.power) * (t - row.end) : -here.stored;
  }

  // The motion resumes from here, at t, without a step that leads to it.
  void stand(int lane, double t, const Sample<double>& here, const TurningUnbalance& unbalance) {
    if (here.r2 > element(peak_, lane)) {
      element(peak_time_, lane) = t;
      element(peak_speed_, lane) = here.speed;
    }
    element(from_.speed, lane) = here.speed;
    element(from_.r2, lane) = here.r2;
    element(from_.slope, lane) = here.slope;
    element(from_.force2, lane) = here.force2;
    element(from_.velocity2, lane) = here.velocity2;
    element(from_.dynamic2, lane) = here.dynamic2;
    element(from_.upright2, lane) = here.upright2;
    element(from_.power, lane) = here.power;
    element(from_.stored, lane) = here.stored;
    for (int k = 0; k < parts; ++k) element(from_unbalance_.part[k], lane) = unbalance[static_cast<std::size_t>(k)];
    for (T* peak : {&peak_, &window_peak_}) element(*peak, lane) = std::fmax(element(*peak, lane), here.r2);
    element(force_peak_, lane) = std::fmax(element(force_peak_, lane), here.force2);
    element(dynamic_peak_, lane) = std::fmax(element(dynamic_peak_, lane), here.dynamic2);
  }

  // Restarts a lane's windows at its present time: nothing before it belongs to its end.
  void restart(int lane, double t) {
    open(lane, t, element(from_.r2, lane));
    closed_[lane] = {};
    count_[lane] = 0;
  }

  // The next piece of the drive begins.
  void end_piece(int lane) {
    work_before_[lane] = work_of(lane);
    work_before_[lane].end_piece();
    element(work_, lane) = -element(from_.stored, lane);
  }

  // The drive's work counts no further.
  void end_work(int lane) { known_work_[lane] = work_of(lane); }

  // Adds an accepted step of length h from `begin` to t, sampled `at` its two nodes and its end; `unbalance`: at its
  // end. Returns the bits of the `active` lanes whose window it ends. Not `asked`: limits and work are required
  // elsewhere.
  template <bool asked = true, class Limited = Alone>
  HWY_INLINE unsigned add(const Limits<T>& limits, unsigned active, Flags accepted, T begin, T t, T h,
                          const Sample<T> (&at)[3], const Turning& unbalance, const Limited& limited = {}) {
    const StepSamples<T> samples = samples_of(at);
    const SquaredRadiusOfStep<T> r2(samples, h);
    const auto force2 = Cubic<T>::through(samples.force2);
    keep(accepted, raised(force_peak_, force2), force_peak_);
    T peak = peak_, window_peak = window_peak_, where(0.0);
    raise(peak, window_peak, r2, where);
    const auto raised_here = both(accepted, peak_ < peak);
    keep(raised_here, multiply_add(h, where, begin), peak_time_);
    keep(raised_here, multiply_add(where, at[2].speed - from_.speed, from_.speed), peak_speed_);
    keep(accepted, at[2].speed, from_.speed);
    keep(accepted, peak, peak_);
    keep(accepted, window_peak, window_peak_);
    if constexpr (asked) watch_limits(limits, accepted, limited(r2), begin, h);
    keep(accepted, multiply_add(h, force2.integral(), window_force_), window_force_);
    const T velocity = Cubic<T>::through(samples.velocity2).integral();
    keep(accepted, multiply_add(h, velocity, window_velocity_), window_velocity_);
    if (limits.by_direction) {
      const auto dynamic2 = Cubic<T>::through(samples.dynamic2);
      keep(accepted, raised(dynamic_peak_, dynamic2), dynamic_peak_);
      keep(accepted, multiply_add(h, dynamic2.integral(), window_dynamic_), window_dynamic_);
      const T upright = Cubic<T>::through(samples.upright2).integral();
      keep(accepted, multiply_add(h, upright, window_upright_), window_upright_);
      keep(accepted, at[2].dynamic2, from_.dynamic2);
      keep(accepted, at[2].upright2, from_.upright2);
    }
    by_direction_ = limits.by_direction;
    for (int k = 0; k < parts; ++k) {
      T &from = from_unbalance_.part[k], &sum = window_unbalance_.part[k];
      keep(accepted, multiply_add(T(0.5) * h, from + unbalance.part[k], sum), sum);
      keep(accepted, unbalance.part[k], from);
    }
    keep(accepted, at[2].r2, from_.r2);
    keep(accepted, at[2].slope, from_.slope);
    keep(accepted, at[2].force2, from_.force2);
    keep(accepted, at[2].velocity2, from_.velocity2);
    if (asked && limits.working) {
      keep(accepted, multiply_add(h, Cubic<T>::through(samples.power).integral(), work_), work_);
      keep(accepted, at[2].power, from_.power);
      keep(accepted, at[2].stored, from_.stored);
    }
    const unsigned full = active & bits_of(accepted) & ~bits_of(t < window_begin_ + limits.window);
    if (full) close(full, t);
    return full;
  }

  // r^2 over a step from the last sample.
  HWY_INLINE SquaredRadiusOfStep<T> curve(T h, const Sample<T> (&at)[3]) const { return {samples_of(at), h}; }

  // The last window that has ended, those at the last two powers of two before it, and how many have since restart().
  const std::array<TransientWindow, 3>& windows(int lane) const { return closed_[lane]; }
  int window_count(int lane) const { return count_[lane]; }

  // Largest r^2 since load().
  double peak(int lane) const { return element(peak_, lane); }

  void store(int lane, double t, TransientSums& row, bool free = true) const {
    row.end = t;
    RadialPeak& peak = free ? row.free_peak : row.clamped_peak;
    peak.square = element(peak_, lane);
    peak.time = element(peak_time_, lane);
    peak.speed = element(peak_speed_, lane);
    row.force_peak = element(force_peak_, lane);
    row.dynamic_peak = element(by_direction_ ? dynamic_peak_ : force_peak_, lane);
    row.time_above = element(time_above_, lane);
    row.last_above = element(last_above_, lane);
    row.work = known_work_[lane].value_or(work_of(lane));
    // The last ended window is empty unless the open one follows it.
    row.window = last_windows(closed_[lane][0], open_window(lane, t));
    if (row.window.length > 0.0) return;
    // Lost in its first step: only the state there is known.
    const double velocity2 = element(from_.velocity2, lane), upright2 = element(from_.upright2, lane);
    row.window = {1.0,
                  element(from_.r2, lane),
                  element(from_.force2, lane),
                  velocity2,
                  of_lane(from_unbalance_, lane),
                  element(from_.dynamic2, lane),
                  {velocity2 - upright2, upright2}};
  }

 private:
  static TurningUnbalance of_lane(const Turning& all, int lane) {
    TurningUnbalance one{};
    for (int k = 0; k < parts; ++k) one[static_cast<std::size_t>(k)] = element(all.part[k], lane);
    return one;
  }

  static HWY_INLINE void keep(Flags accepted, T value, T& kept) { kept = choose(accepted, value, kept); }

  HWY_INLINE StepSamples<T> samples_of(const Sample<T> (&at)[3]) const {
    StepSamples<T> s;
    for (int k = 0; k < 4; ++k) {
      const Sample<T>& here = k == 0 ? from_ : at[k - 1];
      s.r2[k] = here.r2;
      s.slope[k] = here.slope;
      s.force2[k] = here.force2;
      s.velocity2[k] = here.velocity2;
      s.dynamic2[k] = here.dynamic2;
      s.upright2[k] = here.upright2;
      s.power[k] = here.power;
    }
    return s;
  }

  template <class Curve>
  HWY_INLINE void watch_limits(const Limits<T>& limits, Flags accepted, const Curve& r2, T begin, T h) {
    if (limits.timed) {
      T total = time_above_, unused(0.0);
      time_above(r2, limits.displacement2, begin, h, total, unused);
      keep(accepted, total, time_above_);
    }
    if (limits.settling) {
      T unused(0.0), last = last_above_;
      time_above(r2, limits.settled2, begin, h, unused, last);
      keep(accepted, last, last_above_);
    }
  }

  HWY_NOINLINE void close(unsigned full, T t) {
    for (int lane = 0; lane < lanes; ++lane) {
      if (!(full & (1u << lane))) continue;
      const double now = element(t, lane);
      auto& [last, half, quarter] = closed_[lane];
      if (const int n = count_[lane]++; (n & (n - 1)) == 0) {
        quarter = half;
        half = last;
      }
      last = open_window(lane, now);
      open(lane, now, element(from_.r2, lane));
    }
  }

  DriveWork work_of(int lane) const {
    DriveWork work = work_before_[lane];
    work.stored = element(from_.stored, lane);
    work.piece = element(work_, lane) + work.stored;
    work.power = element(from_.power, lane);
    work.begun = true;
    return work;
  }

  TransientWindow open_window(int lane, double t) const {
    const double force = element(window_force_, lane), velocity = element(window_velocity_, lane);
    const double upright = by_direction_ ? element(window_upright_, lane) : 0.5 * velocity;
    return {t - element(window_begin_, lane),
            element(window_peak_, lane),
            force,
            velocity,
            of_lane(window_unbalance_, lane),
            by_direction_ ? element(window_dynamic_, lane) : force,
            {velocity - upright, upright}};
  }

  void open(int lane, double t, double r2) {
    element(window_begin_, lane) = t;
    element(window_peak_, lane) = r2;
    element(window_force_, lane) = 0.0;
    element(window_velocity_, lane) = element(window_dynamic_, lane) = element(window_upright_, lane) = 0.0;
    for (T& sum : window_unbalance_.part) element(sum, lane) = 0.0;
  }

  Sample<T> from_{};  // the step's beginning
  Turning from_unbalance_{}, window_unbalance_{};
  bool by_direction_ = true;
  T peak_{}, peak_time_{}, peak_speed_{}, force_peak_{}, dynamic_peak_{}, time_above_{}, last_above_{};
  T window_begin_{}, window_peak_{}, window_force_{}, window_velocity_{}, window_dynamic_{}, window_upright_{};
  T work_{};                                      // of the current piece, without the stored energy
  DriveWork work_before_[lanes];                  // as loaded
  std::optional<DriveWork> known_work_[lanes];    // once the work has ended
  std::array<TransientWindow, 3> closed_[lanes];  // the last three, latest first
  int count_[lanes] = {};                         // since restart()
};

// At `most` places or fewer, of which the worst one counts: one, or several of a tilting rotor. No place moves more
// than both of the first two, to which limits are held; the rest have forces of their own.
template <class T, int most = static_cast<int>(model::most_bearings), int parts = 4>
class GatherPlaces {
 public:
  using One = GatherTransients<T, parts>;
  using Flags = typename One::Flags;
  using Turning = typename One::Turning;
  static constexpr int lanes = One::lanes;

  void load(int lane, const TransientSums& row, bool free = true) {
    for (One& one : places_) one.load(lane, row, free);
  }
  void resume(int lane, const TransientSums& row, double t, const Sample<double>& here) {
    places_[0].resume(lane, row, t, here);
  }
  // As many places are watched as `here` has, always.
  void stand(int lane, double t, std::span<const Sample<double>> here, const TurningUnbalance& unbalance) {
    count_ = static_cast<int>(here.size());
    for (int k = 0; k < count(); ++k) places_[k].stand(lane, t, here[static_cast<std::size_t>(k)], unbalance);
  }
  void restart(int lane, double t) {
    for (One& one : places_) one.restart(lane, t);
  }
  void end_piece(int lane) { places_[0].end_piece(lane); }
  void end_work(int lane) { places_[0].end_work(lane); }

  HWY_INLINE unsigned add(const Limits<T>& limits, unsigned active, Flags accepted, T begin, T t, T h,
                          const Sample<T> (&at)[3], const Turning& unbalance) {
    return places_[0].add(limits, active, accepted, begin, t, h, at, unbalance);
  }
  HWY_INLINE unsigned add(const Limits<T>& limits, unsigned active, Flags accepted, T begin, T t, T h,
                          const Sample<T> (&at)[3], const Sample<T> (&there)[3], const Turning& unbalance) {
    const SquaredRadiusOfStep<T> other = places_[1].curve(h, there);
    const unsigned full = places_[0].add(limits, active, accepted, begin, t, h, at, unbalance, Beside<T>{other});
    add_place(1, limits, active, accepted, begin, t, h, there, unbalance);
    return full;
  }
  // The same step of place k, after the first two.
  HWY_INLINE void add_place(int k, const Limits<T>& limits, unsigned active, Flags accepted, T begin, T t, T h,
                            const Sample<T> (&at)[3], const Turning& unbalance) {
    places_[k].template add<false>(limits, active, accepted, begin, t, h, at, unbalance);
  }

  // Whether a decided trajectory may end with the window that has just ended; `free_peak`: largest r^2 since release.
  bool seen_enough(int lane, const TransientSettings& settings, const KnownEnd& end, double free_peak) const {
    std::array<TransientWindow, 3> worst = places_[0].windows(lane);
    for (int k = 1; k < count(); ++k)
      for (std::size_t w = 0; w < worst.size(); ++w) worst[w] = worse_of(worst[w], places_[k].windows(lane)[w]);
    return equipoise::seen_enough(settings, end, {worst[1], worst[2]}, worst[0], places_[0].window_count(lane),
                                  free_peak);
  }
  double peak(int lane) const {
    double peak = places_[0].peak(lane);
    for (int k = 1; k < count(); ++k) peak = std::fmax(peak, places_[k].peak(lane));
    return peak;
  }

  void store(int lane, double t, TransientSums& row, bool free = true) const {
    places_[0].store(lane, t, row, free);
    for (int k = 1; k < count(); ++k) {
      TransientSums other;
      places_[k].store(lane, t, other, free);
      row.free_peak = larger(row.free_peak, other.free_peak);
      row.clamped_peak = larger(row.clamped_peak, other.clamped_peak);
      row.force_peak = std::fmax(row.force_peak, other.force_peak);
      row.dynamic_peak = std::fmax(row.dynamic_peak, other.dynamic_peak);
      row.window = worse_of(row.window, other.window);
    }
  }

 private:
  int count() const { return most == 1 ? 1 : count_; }  // a constant for one

  One places_[most];
  int count_ = 1;
};

}  // namespace transient
}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
