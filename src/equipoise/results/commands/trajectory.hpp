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
  bool tilts = false;                                  ///< of a rotor that tilts
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

/// One array of them, or one a ball, or one a bearing. Those of a tilt are left out if the rotor does not tilt, and
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
inline constexpr auto trajectory_columns = std::to_array<TrajectoryColumn>({
    {{"t", "time", study::Dimension::time}, &Trajectory::t},
    {{"psi", "rotor angle", study::Dimension::angle}, &Trajectory::psi},
    {{"psi_dot", "rotor speed", study::Dimension::speed}, &Trajectory::psi_dot},
    {{"x", "centre of the race along the rotating x axis", study::Dimension::length}, &Trajectory::x},
    {{"y", "centre of the race along the rotating y axis", study::Dimension::length}, &Trajectory::y},
    {{"x_dot", "rotating-frame derivative of x", study::Dimension::velocity}, &Trajectory::x_dot},
    {{"y_dot", "rotating-frame derivative of y", study::Dimension::velocity}, &Trajectory::y_dot},
    {{"tilt_x", "slope of the shaft along the rotating x axis", study::Dimension::angle},
     &Trajectory::tilt_x,
     TrajectoryColumn::Of::tilt},
    {{"tilt_y", "slope of the shaft along the rotating y axis", study::Dimension::angle},
     &Trajectory::tilt_y,
     TrajectoryColumn::Of::tilt},
    {{"tilt_x_dot", "rotating-frame derivative of tilt_x", study::Dimension::speed},
     &Trajectory::tilt_x_dot,
     TrajectoryColumn::Of::tilt},
    {{"tilt_y_dot", "rotating-frame derivative of tilt_y", study::Dimension::speed},
     &Trajectory::tilt_y_dot,
     TrajectoryColumn::Of::tilt},
    {{"phi", "ball angle in the rotating frame, not wrapped", study::Dimension::angle},
     nullptr,
     TrajectoryColumn::Of::ball,
     &Trajectory::phi},
    {{"phi_dot", "rate of the ball angle", study::Dimension::speed},
     nullptr,
     TrajectoryColumn::Of::ball,
     &Trajectory::phi_dot},
    {{"radial", "displacement from the place of rest under gravity", study::Dimension::length}, &Trajectory::radial},
    {{"bearing_x", "force on the supports along the fixed X axis", study::Dimension::force}, &Trajectory::bearing_x},
    {{"bearing_y", "force on the supports along the fixed Y axis, the weight included", study::Dimension::force},
     &Trajectory::bearing_y},
    {{"bearing_radial", "displacement at a bearing from its place of rest under gravity", study::Dimension::length},
     nullptr,
     TrajectoryColumn::Of::bearing,
     &Trajectory::bearing_radial},
    {{"bearing_force", "size of the force on a bearing, the weight included", study::Dimension::force},
     nullptr,
     TrajectoryColumn::Of::bearing,
     &Trajectory::bearing_force},
});

/// One word for people's programs.
constexpr const char* name_of(IntegrationStatus status) {
  return status == IntegrationStatus::done ? "done" : status == IntegrationStatus::diverged ? "diverged" : "failed";
}

}  // namespace equipoise
