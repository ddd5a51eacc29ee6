// The file of a design: ensembles are kept as they come, the result is written whole at the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"

namespace equipoise {

using KeptSamples = std::map<std::uint64_t, KeptSample>;  ///< by the number of their question

namespace io {

/// The results are NetCDF (classic, 64-bit offsets), sealed: by ensemble its starts, its figures with their intervals,
/// and its candidate as text; by member of the front its figures on the held-out starts. Records are ensembles
/// (sweep_cells.hpp), at most `most`. `kept` receives the known ones. Throws like CellFile.
std::unique_ptr<CellFile> open_design_file(const std::string& path, const std::string& identity, std::size_t most,
                                           KeptSamples& kept);
/// Of a partial design, the ensembles stay in the unfinished part.
void finish_design_file(CellFile& file, const DesignResult& result, std::size_t most, const KeptSamples& kept);

}  // namespace io
}  // namespace equipoise
