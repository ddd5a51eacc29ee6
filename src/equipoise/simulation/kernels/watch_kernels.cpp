// The watches that kernels of all kinds may carry. Highway's foreach_target compiles this file once per CPU target.
#include <cmath>
#include <cstddef>
#include <limits>

#include "equipoise/simulation/batch/batch_task.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "equipoise/simulation/kernels/watch_kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "equipoise/simulation/batch/batch_watch-inl.hpp"
#include "equipoise/simulation/transients/watch_transients-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Records displacement in windows of time. Within a step r^2 is the cubic through its values and slopes at both ends.
// The slope needs no derivative of the state: r r' = x x' + y y' = x u + y v, since the rotation of the frame drops
// out.
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
  static double value_at(const transient::Cubic<double>& c, double s) {
    if (s >= 1.0) return c.to;
    const double value = c.at(s);
    return value > 0.0 ? value : 0.0;
  }

  // Where the cubic is largest inside the step; outside (0, 1), or not a number, if it has no such place.
  static double peak_of(const transient::Cubic<double>& c) {
    const double discriminant = c.c2 * c.c2 - 3.0 * c.c3 * c.c1;
    if (!(discriminant > 0.0)) return -1.0;
    return c.c1 / (std::sqrt(discriminant) - c.c2);  // the root of the slope where the curvature is negative
  }

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
    const auto radius = [&](int k) {
      return transient::Cubic<double>::hermite(value_[k][slot], h * slope_[k][slot], value[k], h * slope[k]);
    };
    const transient::Cubic<double> radii[2] = {radius(0), radius(places_ - 1)};
    double peak[2];
    bool peak_waits[2];
    for (int k = 0; k < places_; ++k) {
      peak[k] = peak_of(radii[k]);
      peak_waits[k] = peak[k] > 0.0 && peak[k] < 1.0;
    }
    while (edge(slot) <= t) {
      const double end = edge(slot);
      double last = 0.0;
      for (int k = 0; k < places_; ++k) {
        if (peak_waits[k] && from + peak[k] * h <= end) {
          raise(slot, value_at(radii[k], peak[k]));
          peak_waits[k] = false;
        }
        last = std::fmax(last, value_at(radii[k], (end - from) / h));
      }
      finish_window(slot, last);
    }
    for (int k = 0; k < places_; ++k) {
      if (peak_waits[k]) raise(slot, value_at(radii[k], peak[k]));
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

std::unique_ptr<BatchWatch> watch_of(const BatchTask& task) {
  const bool tilting = !task.held && task.kind() == BatchKind::tilting;  // held rotors stand upright
  if (task.transients && tilting) return std::make_unique<WatchTransients<true>>(task, *task.transients);
  if (task.transients) return std::make_unique<WatchTransients<false>>(task, *task.transients);
  if (task.radius) return std::make_unique<WatchRadius>(*task.radius);
  return nullptr;
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();
