// One trajectory at stated times.
#pragma once

#include <vector>

#include "equipoise/types/status.hpp"

namespace equipoise {

/// States at the requested times, one entry per time in every array (per ball: phi[ball][time]). Where psi' jumps
/// (published law), the entry at that time is the state after the jump.
struct Trajectory {
  IntegrationStatus status = IntegrationStatus::done;  ///< if not `done`, later times are missing from every array
  bool stopped = false;                                ///< ended early by the stop flag
  std::vector<double> t;
  std::vector<double> psi, psi_dot;               ///< rotor angle and rate
  std::vector<double> x, y, x_dot, y_dot;         ///< centre O and its derivatives in the rotating frame
  std::vector<std::vector<double>> phi, phi_dot;  ///< ball angles (unwrapped) and rates in the rotating frame
  std::vector<double> radial;                     ///< distance of O from its rest position under gravity
  std::vector<double> bearing_x, bearing_y;       ///< zeta X' + kappa X in fixed axes, including the weight
};

}  // namespace equipoise
