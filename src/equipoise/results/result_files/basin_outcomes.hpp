// The outcome of every start of an ensemble, and nothing else, for comparison with another.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "equipoise/results/columns/transient_figures.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

struct BasinOutcomes {
  Study study;
  std::vector<short> outcome;  ///< of start i: an attractor's identifier, or a code such as undecided_code
  struct Name {
    std::string name, alias;
  };
  std::map<short, Name> names;  ///< of all outcomes that occur
  /// If they were gathered: figures of start i, as in StartArrays; of starts that were lost none is a number.
  std::array<std::vector<float>, transient_figures.size()> transients;
  std::vector<float> mean_speed;  ///< of start i, if its rotor is driven
  std::string own_starts;         ///< for the caller's own starts: their number and checksum
  bool partial = false;
};

/// Reads a file that basin() finished. Throws InputError, naming the file, for other or damaged files.
BasinOutcomes read_basin_outcomes(const std::string& path);

}  // namespace equipoise
