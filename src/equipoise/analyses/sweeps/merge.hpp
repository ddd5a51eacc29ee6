// Reads files of sweeps back, and merges several.
#pragma once

#include <string>
#include <vector>

#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

/// Reads a sweep's file, or its unfinished part (.part), as a result. Throws InputError for other or damaged files.
SweepResult stored_sweep(const std::string& path);

/// Merges the files of shards, or of any runs of one sweep, into `output`. Throws InputError if they do not belong to
/// one sweep, or are damaged.
SweepResult merge_sweeps(const std::vector<std::string>& files, const std::string& output);

}  // namespace equipoise
