// The file of capacities: trials kept as they come, written whole in the end.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "equipoise/cell_files/cell_file.hpp"
#include "equipoise/results/capacity_result.hpp"

namespace equipoise::io {

/// The results are NetCDF (classic, 64-bit offsets), sealed: a coordinate for every parameter, along one dimension an
/// axis; by cell the capacity, its interval, whether it lies beyond the range; by cell and trial the value, the
/// balanced share with its interval and the undecided one; cells that are missing are filled. Every variable has units
/// and long_name. Records are trials (sweep_cells.hpp), one or more. `trials`, by cell: filled with those that are
/// known. Throws as CellFile does.
std::unique_ptr<CellFile> open_capacity_file(const std::string& path, const std::string& identity,
                                             std::vector<std::vector<CapacityTrial>>& trials);
/// While cells are missing their trials stand in the unfinished part.
void finish_capacity_file(CellFile& file, const CapacityResult& result);

}  // namespace equipoise::io
