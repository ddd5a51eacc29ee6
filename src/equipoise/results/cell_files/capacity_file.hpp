// The file of capacities: trials are kept as they come, results are written whole at the end.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/results/commands/capacity_result.hpp"

namespace equipoise::io {

/// The results are NetCDF (classic, 64-bit offsets), sealed: a coordinate for every parameter, one dimension per axis;
/// by cell the capacity, its interval, and whether it lies beyond the range; by cell and trial the value, the balanced
/// share with its interval, and the undecided share. Missing cells are filled. Every variable has units and long_name.
/// Records are trials (sweep_cells.hpp), one or more. `trials`, by cell, receives known ones. Throws like CellFile.
std::unique_ptr<CellFile> open_capacity_file(const std::string& path, const std::string& identity,
                                             std::vector<std::vector<CapacityTrial>>& trials);
/// While cells are missing, their trials stay in the unfinished part.
void finish_capacity_file(CellFile& file, const CapacityResult& result);

}  // namespace equipoise::io
