// The seven tables of Wright and Peng (2019) as data: what was printed, for which study, what is wrong with the print;
// and readings that were fitted to the seventh.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/statistics/comparison.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// One printed number.
struct PublishedCell {
  std::string attractor;  ///< "balanced", or the paper's name V1 to V4
  std::string printed;    ///< as the file has it; in percent, or a fraction of one where `fraction`
  bool fraction = false;  ///< cannot be a percentage: less than one start
  PublishedShare share;
};

/// One ensemble: a row of the print, or one cell of a table with an ensemble in every cell.
struct PublishedRow {
  std::string study;       ///< name of its study in studies/paper, without ending
  std::string label;       ///< "T0 = 25"
  std::string series;      ///< what sets it apart from rows of the same parameter: "beta = 0.05"; empty if nothing
  double parameter = 0.0;  ///< the number in `label`
  std::vector<PublishedCell> cells;
  std::string slip;  ///< what is wrong with the printed row; empty if nothing is. Such cells are not judged
};

struct PublishedTable {
  int number = 0;
  std::string title;
  std::string parameter;  ///< "Omega", "T0"
  bool ramps = false;     ///< the speed varies, so that the speed law matters
  std::string unclaimed;  ///< why no agreement is claimed with any cell; empty if it is
  std::vector<PublishedRow> rows;
};

/// All seven. Throws RunError if the library was built without their data.
const std::vector<PublishedTable>& published_tables();

/// The study of a row: the file in studies/paper, its ramp under `law`.
Study study_of(const PublishedRow& row, model::SpeedLaw law);

/// A reading of table 7 that was fitted to its printed shares (docs/table-7.md has the search).
struct Table7Candidate {
  std::string protocol;             ///< laws of rise and fall, release
  std::string test;                 ///< when a start was called balanced
  std::array<double, 4> percent{};  ///< shares it gives
  std::uint64_t starts = 0;         ///< a row
  double chi_squared = 0.0;         ///< deviance from the printed shares
  int fitted = 0, free_cells = 0;   ///< numbers fitted; cells less those
  bool best = false;
};
/// From docs/evidence/table-7-candidates.csv. Throws RunError if the library was built without it.
std::vector<Table7Candidate> table_7_candidates();

/// Where the numbers come from.
extern const char* const published_citation;

}  // namespace equipoise
