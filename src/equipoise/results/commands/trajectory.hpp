// One trajectory at stated times.
#pragma once

#include <array>
#include <vector>

#include "equipoise/results/columns/column.hpp"
#include "equipoise/results/types/status.hpp"

namespace equipoise {

/// States at the requested times, one entry per time in every array (per ball: phi[ball][time]). Where psi' jumps
/// (published law), the entry at that time is the state after the jump.
struct Trajectory {
  IntegrationStatus status = IntegrationStatus::done;  ///< if not `done`, later times are missing from every array
  bool stopped = false;                                ///< ended early by the stop flag
  bool tilts = false;                                  ///< of a tilting rotor
  std::vector<double> t;
  std::vector<double> psi, psi_dot;        ///< rotor angle and rate
  std::vector<double> x, y, x_dot, y_dot;  ///< centre O and its derivatives in the rotating frame
  /// Slopes of the shaft along the rotating axes and their derivatives there; empty unless the rotor tilts.
  std::vector<double> tilt_x, tilt_y, tilt_x_dot, tilt_y_dot;
  std::vector<std::vector<double>> phi, phi_dot;  ///< ball angles (unwrapped) and rates in the rotating frame
  std::vector<double> radial;                     ///< distance of O from its rest position under gravity
  std::vector<double> bearing_x,
      bearing_y;  ///< the sum of the supports' forces: zeta X' + kappa X in fixed axes, including the weight
  /// Distance of the shaft at each of Study::bearings from where it rests there.
  std::vector<std::vector<double>> bearing_radial;
  /// Size of the force on each, the weight included; empty where they are not known one by one (Study::each_bearing()).
  std::vector<std::vector<double>> bearing_force;
};

/// Trajectories from many starts at the same times.
struct Trajectories {
  std::vector<double> times;
  std::vector<Trajectory> runs;  ///< in the order of the starts; of one that is lost on the way, rows end there
  bool stopped = false;          ///< ended early: some runs stop on the way or have no rows
};

/// One array of them, or one per ball, or one per bearing. Those of a tilt are left out if the rotor does not tilt, and
/// those of bearings if the study states none, or not each one's springs.
struct TrajectoryColumn : Column {
  enum class Of { rotor, tilt, ball, bearing };

  std::vector<double> Trajectory::*values;
  Of of = Of::rotor;
  std::vector<std::vector<double>> Trajectory::*each = nullptr;

  bool is_in(const Trajectory& run) const {
    return of == Of::tilt ? run.tilts : of != Of::bearing || !(run.*each).empty();
  }
};
inline constexpr auto trajectory_columns = [] {
  using T = Trajectory;
  using Of = TrajectoryColumn::Of;
  using enum study::Dimension;
  return std::to_array<TrajectoryColumn>({
      {{"t", "time", time}, &T::t},
      {{"psi", "rotor angle", angle}, &T::psi},
      {{"psi_dot", "rotor speed", speed}, &T::psi_dot},
      {{"x", "centre of the race along the rotating x axis", length}, &T::x},
      {{"y", "centre of the race along the rotating y axis", length}, &T::y},
      {{"x_dot", "rotating-frame derivative of x", velocity}, &T::x_dot},
      {{"y_dot", "rotating-frame derivative of y", velocity}, &T::y_dot},
      {{"tilt_x", "slope of the shaft along the rotating x axis", angle}, &T::tilt_x, Of::tilt},
      {{"tilt_y", "slope of the shaft along the rotating y axis", angle}, &T::tilt_y, Of::tilt},
      {{"tilt_x_dot", "rotating-frame derivative of tilt_x", speed}, &T::tilt_x_dot, Of::tilt},
      {{"tilt_y_dot", "rotating-frame derivative of tilt_y", speed}, &T::tilt_y_dot, Of::tilt},
      {{"phi", "ball angle in the rotating frame, not wrapped", angle}, nullptr, Of::ball, &T::phi},
      {{"phi_dot", "rate of the ball angle", speed}, nullptr, Of::ball, &T::phi_dot},
      {{"radial", "displacement from the place of rest under gravity", length}, &T::radial},
      {{"bearing_x", "force on the supports along the fixed X axis", force}, &T::bearing_x},
      {{"bearing_y", "force on the supports along the fixed Y axis, the weight included", force}, &T::bearing_y},
      {{"bearing_radial", "displacement at a bearing from its place of rest under gravity", length},
       nullptr,
       Of::bearing,
       &T::bearing_radial},
      {{"bearing_force", "size of the force on a bearing, the weight included", force},
       nullptr,
       Of::bearing,
       &T::bearing_force},
  });
}();

/// One word for people's programs.
constexpr const char* name_of(IntegrationStatus status) {
  return status == IntegrationStatus::done ? "done" : status == IntegrationStatus::diverged ? "diverged" : "failed";
}

}  // namespace equipoise
