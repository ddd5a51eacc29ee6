// One trajectory at stated times.
#pragma once

#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/integrate/status.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// States at the requested times, one entry a time in every array (per ball: phi[ball][time]).
/// Where psi' jumps (published law), the entry at the jump's time is the state after it.
struct Trajectory {
  IntegrationStatus status = IntegrationStatus::done;  ///< if not `done`, later times are missing from every array
  bool stopped = false;                                ///< ended early by the stop flag
  std::vector<double> t;
  std::vector<double> psi, psi_dot;                  ///< rotor angle and rate
  std::vector<double> x, y, x_dot, y_dot;            ///< centre O and its derivatives in the rotating frame
  std::vector<std::vector<double>> phi, phi_dot;     ///< ball angles (unwrapped) and rates in the rotating frame
  std::vector<double> radial;                        ///< sqrt(x^2 + y^2)
  std::vector<double> bearing_x, bearing_y;          ///< zeta X' + kappa X in fixed axes
};

/// Integrates `study` from its initial state and samples it by dense output at `times` (increasing, >= 0).
/// Tolerance: study.numerics.tolerance, else default_simulate_tolerance, per step, relative to each variable's size.
/// Throws InputError for times out of order or an invalid study.
Trajectory simulate(const Study& study, const std::vector<double>& times, const StopFlag* stop = nullptr);

}  // namespace equipoise
