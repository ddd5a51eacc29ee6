// What a lane block works on: many trajectories of one rotor over one segment.
#pragma once

#include <cstddef>
#include <cstdint>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/model/parameters.hpp"
#include "equipoise/model/speed.hpp"
#include "equipoise/model/strobe.hpp"

namespace equipoise {

struct RadiusWindows;
struct TransientTable;

/// Work done for the trajectories of a task.
struct LaneWork {
  std::uint64_t steps = 0;     ///< tried
  std::uint64_t accepted = 0;  ///< of these

  /// Evaluations of the equations: 12 for every step tried, one where a trajectory begins.
  std::uint64_t evaluations(std::uint64_t trajectories) const { return 12 * steps + trajectories; }
};

/// Trajectories from segment.begin to `end`. A trajectory's result depends on its own initial state and on nothing else
/// here: not on its place, its neighbours or `count`.
struct LaneTask {
  const model::Parameters* parameters = nullptr;
  model::Segment segment{};
  double end = 0.0;          ///< finite, after segment.begin
  double tolerance = 1e-6;   ///< error allowed a step, in units of lane_error_scale()
  std::size_t count = 0;     ///< trajectories
  double* states = nullptr;  ///< count rows of dimension(balls) numbers; states at segment.begin in, final states out
  const StopFlag* stop = nullptr;
  LaneWork* work = nullptr;  ///< if given, the work done is added to it
  // What is gathered on the way, if given; one of the two at most.
  TransientTable* transients = nullptr;  ///< one row a trajectory; what is decided is followed on until its end is seen
  const RadiusWindows* radius = nullptr;  ///< how far the centre of the race was out

  bool watched() const { return transients || radius; }
  /// Whether the equations with anisotropic supports, gravity and balls that roll are needed.
  bool general() const { return model::is_strobed(*parameters) || parameters->rolls; }
};

/// How a trajectory left its lane.
enum class LaneEnd {
  reached_end,
  decided,  ///< the observer ended it
  diverged,
  failed,  ///< the step size vanished
};

/// Size of an error that counts as one: ball angles and rates 1, the rotor's position and velocity the displacement
/// that eccentricity and balls together can make. Constant, so that step control costs no comparison per component.
inline double lane_error_scale(const model::Parameters& p, int component) {
  return component < 4 ? p.all_unbalances() : 1.0;
}

}  // namespace equipoise
