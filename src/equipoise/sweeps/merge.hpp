// Files of sweeps read back: what was asked, what is there, and several put together.
#pragma once

#include <string>
#include <vector>

#include "equipoise/results/sweep_result.hpp"

namespace equipoise {

/// A file that sweep() wrote, or its unfinished part (.part), as a result. Throws InputError if it is neither or
/// damaged.
SweepResult stored_sweep(const std::string& path);

/// Puts the files of shards, or of any runs of one sweep, together into `output`. Throws InputError if they are not of
/// one sweep, or damaged.
SweepResult merge_sweeps(const std::vector<std::string>& files, const std::string& output);

}  // namespace equipoise
