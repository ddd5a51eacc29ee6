// The outcome of every start of an ensemble, and nothing else, for comparison with another.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "equipoise/study/study.hpp"

namespace equipoise {

struct BasinOutcomes {
  Study study;
  std::vector<short> outcome;  ///< of start i: an attractor's identifier, or a code such as undecided_code
  struct Name {
    std::string name, alias;
  };
  std::map<short, Name> names;  ///< of all outcomes that occur
  std::string own_starts;       ///< for the caller's own starts: their number and checksum
  bool partial = false;
};

/// Reads a file that basin() finished. Throws InputError, naming the file, for other or damaged files.
BasinOutcomes read_basin_outcomes(const std::string& path);

}  // namespace equipoise
