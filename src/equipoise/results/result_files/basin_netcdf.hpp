// The NetCDF file of an ensemble's results, written in one go.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "equipoise/results/columns/dataset.hpp"
#include "equipoise/results/commands/transient_result.hpp"
#include "equipoise/results/result_files/basin_file.hpp"

namespace equipoise::io {

/// The content of such a file.
struct BasinContents : BasinEnd {
  const BasinFileHeader& header;
  std::uint64_t starts = 0;                               ///< 1 or more
  std::function<DataValues(std::size_t column)> columns;  ///< their values (start_columns.hpp)
  std::vector<std::vector<double>> discoveries;
  std::vector<std::string> cpu_targets;
};

/// Replaces `path`, sealed (replacement.hpp). Throws RunError, with the old file as it was.
void write_basin_netcdf(const std::string& path, const BasinContents& contents);

}  // namespace equipoise::io
