// Inspects any file that this program writes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/results/commands/outcome_share.hpp"

namespace equipoise {

struct Inspection {
  std::string path;
  std::string kind;  ///< "basin", "sweep", "capacity", "design", "map", "branches", "trajectory", "unfinished results";
                     ///< empty: unknown
  std::string version;  ///< of the program that wrote it
  std::uint64_t bytes = 0;
  std::string damage;                                      ///< in words that follow the file's name; empty: none
  std::optional<bool> complete;                            ///< if the file says, and is not damaged
  std::vector<std::pair<std::string, std::string>> facts;  ///< by name: starts, cells, what varies
  std::vector<OutcomeShare> outcomes;  ///< for an ensemble or a basin slice; only the estimates of their shares
  std::string study;                   ///< TOML; empty if nothing could be read
};

/// Damage is reported, not thrown: the sound part of an unfinished file is counted. Changes nothing. Throws InputError
/// for files that cannot be read, are in use, or hold no results.
Inspection inspect_file(const std::string& path);

}  // namespace equipoise
