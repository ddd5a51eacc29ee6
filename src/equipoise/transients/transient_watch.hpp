// The statistics of transients for one trajectory in double precision: what transients/watch_transients-inl.hpp gathers
// in SIMD lanes, with the same arithmetic within a step, for time loops without lanes.
//
//     TransientWatch watch(settings, sums);        // sums: of the clamped spin-up, or TransientSums{}
//     watch.begin(sample_at(t));                   // again wherever u, v or the force jumps
//     for each step from t to t + h:
//       watch.step({sample_at(t + h * TransientWatch::nodes[0]), ..[1], sample_at(t + h)});
//       if (its outcome has just been decided) watch.decided({figures of the motion that it comes to, if known});
//       if (watch.may_leave()) stop;
//     watch.finish();                              // at the horizon too
//     transient_row(settings, watch.sums(), lost, figures);
#pragma once

#include <array>

#include "equipoise/transients/transient_table.hpp"

namespace equipoise {

/// The motion at one time. Frame invariant: rotating or fixed components give the same.
struct TransientSample {
  double t = 0.0;          ///< study time
  double r2 = 0.0;         ///< squared distance of O from where the rotor rests under its weight
  double r2_slope = 0.0;   ///< its derivative: twice that distance times (u, v)
  double force2 = 0.0;     ///< |f|^2 of the bearing force
  double velocity2 = 0.0;  ///< u^2 + v^2
  double unbalance = 0.0;  ///< |lambda + sum mu_i e^{i phi_i}|; read at step ends only
};

/// Peaks, integrals and times of one trajectory.
class TransientWatch {
 public:
  /// Where within a step, from 0 to 1, the samples of step() lie.
  static constexpr std::array<double, 3> nodes{1.0 / 3, 0.6, 1.0};

  explicit TransientWatch(const TransientSettings& settings, const TransientSums& sums = {});

  /// The motion goes on from here; `free`: the balls have been released (from settings.release on).
  void begin(const TransientSample& first, bool free = true);
  /// A step from the last sample on.
  void step(const std::array<TransientSample, 3>& samples);
  /// The outcome is known at the end of the last step: windows count from here.
  void decided(const KnownEnd& end);
  /// Whether a decided trajectory has been followed far enough (seen_enough()).
  bool may_leave() const { return may_leave_; }
  /// Completes the last window of a trajectory that ends, for whatever reason.
  void finish();

  const TransientSums& sums() const { return sums_; }

 private:
  void open_window();

  TransientSettings settings_;
  TransientSums sums_;
  TransientSample last_{};
  KnownEnd end_;
  TransientWindow open_;
  std::array<TransientWindow, 2> closed_;  // the nearest first; empty unless they end where open_ begins
  double opened_ = 0.0;                    // when open_ began
  int windows_ = 0;                        // since the decision
  bool begun_ = false, free_ = true, decided_ = false, may_leave_ = false;
};

}  // namespace equipoise
