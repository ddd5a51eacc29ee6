// Child processes whose output and resources are wanted.
#pragma once

#include <string>
#include <vector>

namespace equipoise::bench {

struct ChildResult {
  bool ran = false;    ///< started and ended with exit code 0
  std::string output;  ///< its standard output
  double peak_megabytes = 0.0;
  double cpu_seconds = 0.0;  ///< of all its threads
};

/// Runs `command` (looked up in PATH) with `input` as its standard input, at most 64 KiB. Its standard error is ours,
/// or nobody's if `silent`.
ChildResult run_child(const std::vector<std::string>& command, const std::string& input = "", bool silent = false);

/// A name in the folder for temporary files that no other process uses.
std::string temporary_path(const std::string& ending);

}  // namespace equipoise::bench
