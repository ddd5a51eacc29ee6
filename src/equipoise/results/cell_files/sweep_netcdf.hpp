// The NetCDF file of a sweep's results, written in one go.
#pragma once

#include <string>

#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise::io {

/// Replaces `path` with a sealed file (sealed_file.hpp). Its content depends only on the result, not on how long it
/// took. Throws RunError, with the old file as it was.
void write_sweep_netcdf(const std::string& path, const std::string& identity, const SweepResult& result);

}  // namespace equipoise::io
