// The result of a continuation along a parameter.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/results/commands/branch.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

struct BranchesResult {
  Study study;                 ///< as given; its own value of the parameter plays no part
  std::string key;             ///< of the parameter
  std::vector<double> values;  ///< rising
  double step = 0.0;
  std::uint64_t starts = 0;      ///< random starts searched at every value and half-way between
  std::vector<Branch> branches;  ///< by identifier
  bool partial = false;          ///< stopped before everything was continued
  double seconds = 0.0;
  int threads = 1;
  std::string cpu_target;
};

/// "final rotor speed Omega / critical speed" and so on; the key itself for parameters without a label.
std::string parameter_label(const std::string& key);

}  // namespace equipoise
