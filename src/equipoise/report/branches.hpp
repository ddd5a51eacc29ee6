// Attractors along a parameter, for people and for machines.
#pragma once

#include <string>
#include <vector>

#include "equipoise/results/branch.hpp"
#include "equipoise/store/branches_file.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

struct BranchesResult {
  Study study;                 ///< as given; the parameter's own value in it plays no part
  std::string key;             ///< of the parameter
  std::vector<double> values;  ///< rising
  double step = 0.0;
  std::vector<Branch> branches;  ///< by identifier
  bool partial = false;          ///< stopped before all was followed
  double seconds = 0.0;
  int threads = 1;
  std::string cpu_target;
};

/// "final rotor speed Omega / critical speed" and its like; the key itself for parameters without a name here.
std::string parameter_label(const std::string& key);

/// Tables of branches and events for the terminal.
std::string branches_text(const BranchesResult& result);
/// One JSON object. docs/guide/command-line.md lists the keys.
std::string branches_json(const BranchesResult& result);
/// One line a value and branch, after comment lines with the study and the version.
std::string branches_csv(const BranchesResult& result);
/// What goes into a NetCDF file.
BranchTable branch_table(const BranchesResult& result);

}  // namespace equipoise
