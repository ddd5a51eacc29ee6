// An ensemble in memory as a file of results.
#pragma once

#include <string>
#include <vector>

#include "equipoise/result_files/basin_file.hpp"
#include "equipoise/results/basin_result.hpp"

namespace equipoise {

/// Writes `path` anew: what basin() with that output and the same study would have left there, which goes on from it or
/// reads it as its own (BasinFile). `result` has every start (BasinOptions::keep_starts). Throws InputError if it has
/// not, or if another run's unfinished results stand beside `path`; RunError, with an old file as it was, if the disk
/// cannot take it.
void write_basin_file(const std::string& path, const BasinResult& result);

/// What that file keeps of every start.
std::vector<io::StartColumn> start_columns(const BasinResult& result);

/// The outcomes of an ensemble as its file lists them.
std::vector<OutcomeShare> outcome_summary(const BasinResult& result);

}  // namespace equipoise
