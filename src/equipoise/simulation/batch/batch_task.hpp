// The work of a lane block: many trajectories over one segment of a rotor's motion, or one piece of its drive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/model/held_state.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/batch/own_rotor.hpp"

namespace equipoise {

struct TransientTable;

/// Work done for the trajectories of a task.
struct BatchWork {
  std::uint64_t steps = 0;     ///< tried
  std::uint64_t accepted = 0;  ///< of these
  std::uint64_t events = 0;    ///< impacts, partings, and starts and stops of balls

  /// Evaluations of the equations: 12 for every step tried, one at the beginning of a trajectory.
  std::uint64_t evaluations(std::uint64_t trajectories) const { return 12 * steps + trajectories; }
};

/// A record of displacement: the largest and the last r^2 of every trajectory in windows of time. Two tables of count x
/// windows numbers, row-major. Window k is [k width, (k + 1) width]. Tasks over successive segments of one motion may
/// share them: a window's largest r^2 only grows, and a lost trajectory's stays infinite.
struct RadiusWindows {
  double width = 0.0;       ///< > 0
  std::size_t windows = 0;  ///< per trajectory; later ones are not recorded
  float* largest = nullptr;
  float* at_end = nullptr;
  /// For a tilting rotor: where its slopes are in the state, and the places along its shaft, of which the one further
  /// out counts.
  int tilt = -1;
  std::array<double, 2> places{};
};

/// Which equations a task needs. Plain and turning: a prescribed speed and a centred race; turning adds anisotropic
/// supports, gravity and rolling balls. Smooth: any smooth system. Hybrid: any with contact or dry friction, smooth
/// between events.
/// Tilting: any tilting rotor.
enum class BatchKind { plain, turning, smooth, hybrid, tilting };

/// Trajectories from segment.begin to `end`. Each result depends neither on its place nor on its neighbours.
struct BatchTask {
  const model::Parameters* parameters = nullptr;
  model::Segment segment{};
  double end = 0.0;          ///< finite, after segment.begin
  double tolerance = 1e-6;   ///< error allowed a step, in units of batch_error_scale()
  std::size_t count = 0;     ///< trajectories
  double* states = nullptr;  ///< count rows of dimension() numbers: initial states in, final states out
  const StopFlag* stop = nullptr;
  BatchWork* work = nullptr;  ///< if given, the work done is added to it
  /// Set unless the system is simple (machine/model/system.hpp): gives equations and drive; `segment` repeats the
  /// prescribed part of the drive. Null: `segment` alone says how the rotor turns.
  const model::System* system = nullptr;
  /// When each trajectory begins; null: all with the segment. After release under a motor they differ.
  const double* begins = nullptr;
  /// The rotor of each of `count` trajectories; the task's rotor has what they share. Null: all have the task's.
  const OwnRotor* const* own = nullptr;
  char* met = nullptr;  ///< if given, `count` flags: set to 1 for a trajectory on which balls touch
  bool held = false;    ///< for a driven rotor: its balls are held; states are those of machine/model/held_state.hpp
  // Watches, if given; at most one of the two.
  TransientTable* transients = nullptr;   ///< one row a trajectory; decided ones go on until their end is seen
  const RadiusWindows* radius = nullptr;  ///< displacement of the race's centre

  bool watched() const { return transients || radius; }
  /// When trajectory `start` begins and ends.
  double begin_of(std::size_t start) const {
    if (begins) return begins[start];
    return own ? own[start]->segment.begin : segment.begin;
  }
  double end_of(std::size_t start) const { return own ? own[start]->end : end; }
  BatchKind kind() const {
    if (system && system->tilts()) return BatchKind::tilting;
    if (system) return system->smooth() ? BatchKind::smooth : BatchKind::hybrid;
    return model::depends_on_rotor_angle(*parameters) || parameters->rolls ? BatchKind::turning : BatchKind::plain;
  }
  /// Layout of `states`.
  model::StateLayout layout() const {
    if (!system) return model::StateLayout::of(parameters->balls, false, false, false);
    return held ? model::held_layout(*system) : system->layout();
  }
  int dimension() const { return layout().size; }

  /// Follows these rows in place. `rotors`: their own, or none; `from`: when each begins, or none.
  void take(std::span<double> rows, const std::vector<const OwnRotor*>& rotors, const std::vector<double>& from) {
    count = rows.size() / static_cast<std::size_t>(dimension());
    states = rows.data();
    own = rotors.empty() ? nullptr : rotors.data();
    begins = from.empty() ? nullptr : from.data();
  }
};

/// Trajectories of any system in the last piece of its drive, from time 0 on; a prescribed rotor angle begins at `psi`.
/// The system must outlive the task.
inline BatchTask batch_task(const model::System& system, double psi = 0.0) {
  BatchTask task;
  task.parameters = &system.parameters();
  task.segment = {0.0, 1e300, psi, system.drive().speed, 0.0, false};
  if (!system.simple()) task.system = &system;
  return task;
}

/// Why a trajectory left its lane.
enum class BatchEnd {
  reached_end,
  decided,  ///< the observer ended it
  diverged,
  failed,  ///< the step size vanished
};

/// Unit of the error of a component: lambda + sum mu_i for the rotor's position and velocity, and for those of its
/// tilt, which begin at `tilt`; 1 for all others. Constant, so that step control costs no comparison per component.
inline double batch_error_scale(const model::Parameters& p, int component, int tilt = -1) {
  return component < 4 || (tilt >= 0 && component >= tilt) ? p.motion_scale() : 1.0;
}

}  // namespace equipoise
