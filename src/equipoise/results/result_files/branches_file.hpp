// Attractors along a parameter as NetCDF.
#pragma once

#include <string>

#include "equipoise/results/commands/branch.hpp"

namespace equipoise {

/// Writes `path` again: dimensions value, attractor, ball and event; variables kind, stable, motion_numbers and of
/// driven rotors motor_numbers (value, attractor), and drift(value, attractor, ball), filled where the attractor is not
/// there; id, name, alias(attractor); event_*(event). Without attractors or events those dimensions and their variables
/// are left out. Every variable has units and long_name; readable by xarray, ncdump, ncview. Throws RunError if the
/// file cannot be written.
void write_branches_file(const std::string& path, const BranchesResult& result);

}  // namespace equipoise
