// Trajectories as CSV and as NetCDF.
#pragma once

#include <string>

#include "equipoise/results/commands/trajectory.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The trajectory_columns, of every ball phi_1 and so on; every number in the shortest form that reads back to the same
/// bits. Titles of a study in physical units name the unit of their numbers, such as "t (1/omega_c)".
std::string trajectory_csv(const Trajectory& trajectory, const Study& study);

/// The same of many, behind a first column `start`.
std::string trajectory_csv(const Trajectories& trajectories, const Study& study);

/// A trajectory as NetCDF with coordinate t, `study` (TOML) as an attribute. Replaces an existing file.
/// Throws RunError if it cannot be written.
void write_netcdf(const std::string& path, const Trajectory& trajectory, const std::string& study);

/// The same of many along a dimension `start`; where a run is lost, its later values are not-a-number.
void write_netcdf(const std::string& path, const Trajectories& trajectories, const std::string& study);

}  // namespace equipoise
