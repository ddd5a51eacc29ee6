// One trajectory at stated times, and its files.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "equipoise/integrate/status.hpp"

namespace equipoise {

/// States at the requested times, one entry a time in every array (per ball: phi[ball][time]).
/// Where psi' jumps (published law), the entry at the jump's time is the state after it.
struct Trajectory {
  IntegrationStatus status = IntegrationStatus::done;  ///< if not `done`, later times are missing from every array
  bool stopped = false;                                ///< ended early by the stop flag
  std::vector<double> t;
  std::vector<double> psi, psi_dot;               ///< rotor angle and rate
  std::vector<double> x, y, x_dot, y_dot;         ///< centre O and its derivatives in the rotating frame
  std::vector<std::vector<double>> phi, phi_dot;  ///< ball angles (unwrapped) and rates in the rotating frame
  std::vector<double> radial;                     ///< distance of O from where gravity lets it rest
  std::vector<double> bearing_x, bearing_y;       ///< zeta X' + kappa X in fixed axes: the weight included
};

/// Columns t, psi, psi_dot, x, y, x_dot, y_dot, phi_1.., phi_dot_1.., radial, bearing_x, bearing_y; every number in the
/// shortest form that reads back to the same bits.
void write_csv(std::ostream& out, const Trajectory& trajectory);

/// The same to a file, which it replaces once all is written. Throws RunError if it cannot be.
void write_csv_file(const std::string& path, const Trajectory& trajectory);

/// The same as NetCDF with coordinate t, `study` (TOML) as an attribute. Replaces an existing file.
/// Throws RunError if it cannot be written.
void write_netcdf(const std::string& path, const Trajectory& trajectory, const std::string& study);

}  // namespace equipoise
