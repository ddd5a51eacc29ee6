// Writes an ensemble that is in memory to a file of results.
#pragma once

#include <string>
#include <vector>

#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/result_files/start_columns.hpp"

namespace equipoise {

/// Replaces `path` by the file that basin() with this output and study would have left, so that basin() can read or
/// resume it (BasinFile). `result` must hold every start (BasinOptions::keep_starts). Throws InputError if it does not,
/// or if another run's unfinished results stand next to `path`. Throws RunError if the disk cannot take the file; an
/// old file then stays as it was.
void write_basin_file(const std::string& path, const BasinResult& result);

/// What that file keeps of every start.
std::vector<io::StartColumn> start_columns(const BasinResult& result);

/// The outcomes of an ensemble as its file lists them.
std::vector<OutcomeShare> outcome_summary(const BasinResult& result);

}  // namespace equipoise
