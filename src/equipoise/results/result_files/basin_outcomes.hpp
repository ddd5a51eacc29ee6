// Outcomes in files of results: of every start, for comparison with another ensemble, and the kinds of them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "equipoise/results/columns/dataset.hpp"
#include "equipoise/results/commands/outcome_share.hpp"
#include "equipoise/results/commands/start_arrays.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// What is wrong with a record: start, outcome.
inline constexpr char outcome_without_name[] = "is damaged: start {} has outcome {}, which the file does not name";

/// The starts of an ensemble, in which `outcome` says where each ended.
struct BasinOutcomes : StartArrays {
  Study study;
  struct Name {
    std::string name, alias;
  };
  std::map<short, Name> names;  ///< of all outcomes that occur
  std::string own_starts;       ///< for the caller's own starts: their number and checksum
  bool partial = false;
};

/// Reads a file that basin() finished, without what its starts began with. Throws InputError, naming the file, for
/// other or damaged files.
BasinOutcomes read_basin_outcomes(const std::string& path);

namespace io {

class NetcdfFile;

/// What is wrong with a share that comes from a file, in words; empty if it is a number from 0 to 1.
std::string fault_of_share(double share);

/// Dimension outcome_kind with code, name and alias of each; `before`: of their names, "kind_" in files of starts.
/// Returns the dimension's place. The columns refer to `kinds`.
std::size_t add_outcome_kinds(Dataset& data, const std::string& before, const std::vector<OutcomeShare>& kinds);
/// flag_values and flag_meanings of a column of such codes.
void add_outcome_flags(DataColumn& column, const std::vector<OutcomeShare>& kinds);
/// Their identifiers, names, aliases and shares. Throws RunError if the file has no such columns, or a share is none.
std::vector<OutcomeShare> read_outcome_kinds(const NetcdfFile& file, const std::string& before);
/// The numbers of a share of each kind, read from the column with this name; throws as above.
std::vector<double> read_shares(const NetcdfFile& file, const std::string& name);
/// Throws InputError, naming the file, unless every start has one of these outcomes.
void require_outcomes(const NetcdfFile& file, const std::vector<OutcomeShare>& kinds);

}  // namespace io
}  // namespace equipoise
