// The NetCDF file of an ensemble's results, written in one go.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/results/commands/without_balls.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/result_files/start_columns.hpp"

namespace equipoise::io {

/// The content of such a file.
struct BasinContents {
  const BasinFileHeader& header;
  const std::vector<StartColumn>& columns;
  std::uint64_t starts = 0;  ///< 1 or more
  /// Values of a column of starts first .. first + count - 1.
  std::function<void(std::size_t column, std::uint64_t first, std::size_t count, void* values)> read;
  std::vector<std::vector<double>> discoveries;
  std::vector<std::string> cpu_targets;
  std::vector<OutcomeShare> summary;
  std::string study;
  bool complete = false;
  RunTime time;
  std::optional<WithoutBalls> without_balls{};
  std::optional<TransientGroup> all{};  ///< transients of all starts
};

/// Replaces `path`, sealed (sealed_file.hpp). Throws RunError, with the old file as it was.
void write_basin_netcdf(const std::string& path, const BasinContents& contents);

}  // namespace equipoise::io
