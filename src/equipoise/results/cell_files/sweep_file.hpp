// The finished file of a sweep.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

/// Writes `path` again from a sweep in memory, as sweep() would leave it there. NetCDF (classic, 64-bit offsets),
/// sealed: a coordinate for every parameter, one dimension per axis; outcome kinds with code, name and alias; count,
/// share and its interval, mean decision time and figures of the motion by cell and outcome; quantiles of the
/// transients and shares above limits by cell. Missing cells are filled. Every variable has units and long_name. Throws
/// InputError if unfinished results stand next to it; RunError, with an old file kept, if the disk is full.
void write_sweep_file(const std::string& path, const SweepResult& result);

/// Identity and content of a sweep's results or its unfinished part. Throws InputError for other or damaged files.
struct StoredSweep {
  std::string identity, loss;                               ///< loss: Store::loss()
  std::map<std::size_t, std::shared_ptr<SweepCell>> cells;  ///< by index, below the number of cells in the identity
};
StoredSweep read_sweep(const std::string& path);

}  // namespace equipoise
