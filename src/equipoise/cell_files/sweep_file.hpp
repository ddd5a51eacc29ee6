// The file of a sweep: cells kept as they come, written whole in the end.
#pragma once

#include <memory>
#include <string>

#include "equipoise/results/sweep_result.hpp"

namespace equipoise {

/// Writes `path` anew from a sweep in memory: what sweep() with that output would have left there. NetCDF (classic,
/// 64-bit offsets), sealed: a coordinate for every parameter, along one dimension an axis; outcome kinds with code,
/// name and alias; count, share and its interval, mean decision time and figures of the motion by cell and outcome;
/// quantiles of the transients and shares above limits by cell; cells that are missing are filled. Every variable has
/// units and long_name. Throws InputError if unfinished results stand beside it, RunError, with an old file as it was,
/// if the disk cannot take it.
void write_sweep_file(const std::string& path, const SweepResult& result);

/// Which sweep a file of results or its unfinished part is of, and what it holds. Throws InputError if it is neither or
/// damaged.
struct StoredSweep {
  std::string identity;
  SweepCells cells;
};
StoredSweep read_sweep(const std::string& path);

namespace io {

class CellFile;

/// Records are cells (sweep_cells.hpp). `cells`, as many as there are: filled with those that are known. Throws as
/// CellFile does.
std::unique_ptr<CellFile> open_sweep_file(const std::string& path, const std::string& identity, SweepCells& cells);
/// Of the unfinished part only searches of missing cells stay.
void finish_sweep_file(CellFile& file, const SweepResult& result);

}  // namespace io
}  // namespace equipoise
