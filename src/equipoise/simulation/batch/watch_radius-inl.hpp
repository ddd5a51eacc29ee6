// A watch of lanes that records displacement in windows of time. Included once per CPU target.
//
// Within a step r^2 is the cubic through its values and slopes at both ends. The slope needs no derivative of the
// state: r r' = x x' + y y' = x u + y v, since the rotation of the frame drops out.
#if defined(EQUIPOISE_BATCH_WATCH_RADIUS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_BATCH_WATCH_RADIUS_INL
#undef EQUIPOISE_BATCH_WATCH_RADIUS_INL
#else
#define EQUIPOISE_BATCH_WATCH_RADIUS_INL
#endif

#include <cmath>
#include <cstddef>
#include <limits>

#include "equipoise/simulation/batch/batch_watch-inl.hpp"
#include "equipoise/machine/model/parameters.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// r^2 over one step, as a cubic in s from 0 to 1.
class SquaredRadius {
 public:
  SquaredRadius(double from, double slope_from, double to, double slope_to, double h)
      : c0_(from), c1_(h * slope_from), to_(to) {
    const double d1 = h * slope_to, rise = to - from;
    c2_ = 3.0 * rise - 2.0 * c1_ - d1;
    c3_ = c1_ + d1 - 2.0 * rise;
  }

  double at(double s) const {
    if (s >= 1.0) return to_;
    const double value = c0_ + s * (c1_ + s * (c2_ + s * c3_));
    return value > 0.0 ? value : 0.0;
  }

  // Where the cubic is largest inside the step; outside (0, 1), or not a number, if it has no such place.
  double peak() const {
    const double discriminant = c2_ * c2_ - 3.0 * c3_ * c1_;
    if (!(discriminant > 0.0)) return -1.0;
    return c1_ / (std::sqrt(discriminant) - c2_);  // the root of the slope where the curvature is negative
  }

 private:
  double c0_, c1_, c2_, c3_, to_;
};

class WatchRadius final : public BatchWatch {
 public:
  explicit WatchRadius(const RadiusWindows& record)
      : record_(record), places_(record.tilt >= 0 && record.places[0] != record.places[1] ? 2 : 1) {}

  void begin(int slot, std::size_t start, double t, const double* z) override {
    start_[slot] = start;
    // A trajectory that enters at the edge of two windows belongs to the later one.
    window_[slot] = static_cast<std::size_t>(t / record_.width);
    while (edge(slot) <= t) ++window_[slot];
    corner(slot, t, z);
    for (int k = 0; k < places_; ++k) raise(slot, value_[k][slot]);
  }

  void corner(int slot, double t, const double* z) override {
    t_[slot] = t;
    for (int k = 0; k < places_; ++k) sample(z, k, value_[k][slot], slope_[k][slot]);
  }

  unsigned step(const TriedStep& step) override {
    const unsigned moved = step.active & lane_bits(step.accepted);
    if (!moved) return 0;
    alignas(64) double times[8], values[2][8], slopes[2][8];
    step.t.store(times);
    for (int k = 0; k < places_; ++k) {
      Pack value, slope;
      sample(step.z, k, value, slope);
      value.store(values[k]);
      slope.store(slopes[k]);
    }
    for (int lane = 0; lane < static_cast<int>(pack_lanes); ++lane)
      if (moved & (1u << lane)) {
        const double value[2] = {values[0][lane], values[places_ - 1][lane]};
        const double slope[2] = {slopes[0][lane], slopes[places_ - 1][lane]};
        take(step.group * static_cast<int>(pack_lanes) + lane, times[lane], value, slope);
      }
    return 0;
  }

  void end(int slot, std::size_t, BatchEnd how, double) override {
    if (how == BatchEnd::reached_end) return;
    const std::size_t row = start_[slot] * record_.windows;
    for (std::size_t k = window_[slot]; k < record_.windows; ++k)
      record_.largest[row + k] = record_.at_end[row + k] = std::numeric_limits<float>::infinity();
  }

  void restart(int, double) override {}
  bool seen_enough(int, int) const override { return true; }

 private:
  // r^2 at place k, and its slope.
  template <class T>
  HWY_INLINE void sample(const T* z, int k, T& value, T& slope) const {
    T section[4] = {z[0], z[1], z[2], z[3]};
    if (record_.tilt >= 0)
      for (int i = 0; i < 4; ++i) section[i] = section[i] + T(record_.places[k]) * z[record_.tilt + i];
    using namespace model::index;
    value = section[x] * section[x] + section[y] * section[y];
    slope = T(2.0) * (section[x] * section[u] + section[y] * section[v]);
  }

  double edge(int slot) const { return static_cast<double>(window_[slot] + 1) * record_.width; }

  void raise(int slot, double value) {
    if (window_[slot] >= record_.windows) return;
    float& largest = record_.largest[start_[slot] * record_.windows + window_[slot]];
    if (largest < static_cast<float>(value)) largest = static_cast<float>(value);
  }

  void finish_window(int slot, double value) {
    raise(slot, value);
    if (window_[slot] < record_.windows) {
      float& last = record_.at_end[start_[slot] * record_.windows + window_[slot]];
      if (last < std::numeric_limits<float>::infinity()) last = static_cast<float>(value);
    }
    ++window_[slot];
    raise(slot, value);
  }

  // Takes an accepted step to time t, with r^2 and its slope there.
  void take(int slot, double t, const double* value, const double* slope) {
    const double from = t_[slot], h = t - from;
    const auto radius = [&](int k) { return SquaredRadius(value_[k][slot], slope_[k][slot], value[k], slope[k], h); };
    const SquaredRadius radii[2] = {radius(0), radius(places_ - 1)};
    double peak[2];
    bool peak_waits[2];
    for (int k = 0; k < places_; ++k) {
      peak[k] = radii[k].peak();
      peak_waits[k] = peak[k] > 0.0 && peak[k] < 1.0;
    }
    while (edge(slot) <= t) {
      const double end = edge(slot);
      double last = 0.0;
      for (int k = 0; k < places_; ++k) {
        if (peak_waits[k] && from + peak[k] * h <= end) {
          raise(slot, radii[k].at(peak[k]));
          peak_waits[k] = false;
        }
        last = std::fmax(last, radii[k].at((end - from) / h));
      }
      finish_window(slot, last);
    }
    for (int k = 0; k < places_; ++k) {
      if (peak_waits[k]) raise(slot, radii[k].at(peak[k]));
      raise(slot, value[k]);
      value_[k][slot] = value[k];
      slope_[k][slot] = slope[k];
    }
    t_[slot] = t;
  }

  static constexpr int slots = most_batch_groups * static_cast<int>(pack_lanes);
  const RadiusWindows record_;
  const int places_;  // watched
  std::size_t start_[slots], window_[slots];
  double t_[slots], value_[2][slots], slope_[2][slots];
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
