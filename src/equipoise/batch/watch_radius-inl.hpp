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

#include "equipoise/batch/batch_watch-inl.hpp"
#include "equipoise/batch/radius_windows.hpp"
#include "equipoise/model/parameters.hpp"

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
  explicit WatchRadius(const RadiusWindows& record) : record_(record) {}

  void begin(int slot, std::size_t start, double t, const double* z) override {
    start_[slot] = start;
    // A trajectory that enters at the edge of two windows belongs to the later one.
    window_[slot] = static_cast<std::size_t>(t / record_.width);
    while (edge(slot) <= t) ++window_[slot];
    corner(slot, t, z);
    raise(slot, value_[slot]);
  }

  void corner(int slot, double t, const double* z) override {
    t_[slot] = t;
    value_[slot] = z[model::index::x] * z[model::index::x] + z[model::index::y] * z[model::index::y];
    slope_[slot] = 2.0 * (z[model::index::x] * z[model::index::u] + z[model::index::y] * z[model::index::v]);
  }

  unsigned step(const TriedStep& step) override {
    const unsigned moved = step.active & lane_bits(step.accepted);
    if (!moved) return 0;
    using namespace model::index;
    const Pack* z = step.z;
    const Pack value = z[x] * z[x] + z[y] * z[y], slope = Pack(2.0) * (z[x] * z[u] + z[y] * z[v]);
    alignas(64) double times[8], values[8], slopes[8];
    step.t.store(times);
    value.store(values);
    slope.store(slopes);
    for (int lane = 0; lane < static_cast<int>(pack_lanes); ++lane)
      if (moved & (1u << lane))
        take(step.group * static_cast<int>(pack_lanes) + lane, times[lane], values[lane], slopes[lane]);
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
  void take(int slot, double t, double value, double slope) {
    const double from = t_[slot], h = t - from;
    const SquaredRadius radius(value_[slot], slope_[slot], value, slope, h);
    const double peak = radius.peak(), peak_time = from + peak * h;
    bool peak_waits = peak > 0.0 && peak < 1.0;
    while (edge(slot) <= t) {
      if (peak_waits && peak_time <= edge(slot)) {
        raise(slot, radius.at(peak));
        peak_waits = false;
      }
      finish_window(slot, radius.at((edge(slot) - from) / h));
    }
    if (peak_waits) raise(slot, radius.at(peak));
    raise(slot, value);
    t_[slot] = t;
    value_[slot] = value;
    slope_[slot] = slope;
  }

  static constexpr int slots = most_batch_groups * static_cast<int>(pack_lanes);
  const RadiusWindows record_;
  std::size_t start_[slots], window_[slots];
  double t_[slots], value_[slots], slope_[slots];
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
