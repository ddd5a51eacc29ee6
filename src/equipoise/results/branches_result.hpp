// What a search for attractors along a parameter answered.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/results/branch.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

struct ContinuationResult {
  Study study;                 ///< as given; the parameter's own value in it plays no part
  std::string key;             ///< of the parameter
  std::vector<double> values;  ///< rising
  double step = 0.0;
  std::uint64_t starts = 0;      ///< random ones searched at every value and half-way between
  std::vector<Branch> branches;  ///< by identifier
  bool partial = false;          ///< stopped before all was followed
  double seconds = 0.0;
  int threads = 1;
  std::string cpu_target;
};

/// "final rotor speed Omega / critical speed" and its like; the key itself for parameters without a name here.
std::string parameter_label(const std::string& key);

}  // namespace equipoise
