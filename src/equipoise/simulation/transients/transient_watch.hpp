// The statistics of transients for one trajectory in double precision: the sums that SIMD lanes gather
// (simulation/transients/gather_transients-inl.hpp), for time loops without lanes.
// This room: peaks, forces and settling on the way.
#pragma once

#include <array>
#include <cstddef>

#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/simulation/transients/gather_transients-inl.hpp"
#include "equipoise/results/types/transient_table.hpp"

namespace equipoise {

/// The motion at one time.
struct TransientSample {
  double t = 0.0;                ///< study time
  TurningUnbalance unbalance{};  ///< read at step ends only
  /// The motion at all places that are watched, one unless a rotor tilts. Power and energy are read of the first alone.
  std::array<HWY_NAMESPACE::transient::Sample<double>, model::most_bearings> places{};
  std::size_t count = 1;
};

/// With the balls at `phi`; `shaft`: of a tilting rotor.
TurningUnbalance turning_unbalance(const model::Parameters& p, const WatchedShaft& shaft, const double* phi);

/// Of rotor and balls in state `z` (dimension(balls) numbers) at time `t` and rotor angle `psi`. `tilt`: the four
/// variables of a tilting rotor, which is watched along its `shaft`; null for others.
TransientSample transient_sample(const model::Parameters& p, const WatchedShaft& shaft, double psi, double t,
                                 const double* z, const double* tilt);

class TransientWatch {
 public:
  /// Where within a step, from 0 to 1, the samples of step() lie.
  static constexpr std::array<double, 3> nodes{HWY_NAMESPACE::transient::node1, HWY_NAMESPACE::transient::node2, 1.0};

  explicit TransientWatch(const TransientSettings& settings, const TransientSums& sums = {});

  /// The motion resumes from here, at first and wherever u, v or the force jumps; `free`: balls have been released.
  void begin(const TransientSample& first, bool free = true);
  /// A step from the last sample.
  void step(const std::array<TransientSample, 3>& samples);
  /// The same, to time `to`, sampled by `sample(t)`.
  template <class Sampled>
  void step_to(double to, Sampled&& sample) {
    const double from = t_;
    std::array<TransientSample, 3> samples;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      samples[k] = sample(k + 1 == nodes.size() ? to : from + nodes[k] * (to - from));
    step(samples);
  }
  /// A piece of the drive ends with the last step.
  void end_piece();

  TransientSums sums() const;

 private:
  TransientSettings settings_;
  HWY_NAMESPACE::transient::Limits<double> limits_;
  using Gather = HWY_NAMESPACE::transient::GatherPlaces<double>;
  Gather gathered_;
  TransientSums sums_;  // without the present side of the release
  double t_;
  bool begun_ = false, free_ = true;
};

}  // namespace equipoise
