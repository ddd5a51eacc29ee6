// What every start of an ensemble came to, and no more: to be compared with another.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "equipoise/study/study.hpp"

namespace equipoise {

struct BasinOutcomes {
  Study study;
  std::vector<short> outcome;  ///< of start i: an attractor's identifier, or undecided_code and its like
  struct Name {
    std::string name, alias;
  };
  std::map<short, Name> names;  ///< of all outcomes that there are
  std::string own_starts;       ///< of starts that were the caller's: their number and checksum
  bool partial = false;
};

/// Of a file that basin() wrote and finished. Throws InputError, naming the file, if it is none or is damaged.
BasinOutcomes read_basin_outcomes(const std::string& path);

}  // namespace equipoise
