// Readings of table 7 that were fitted to its printed shares, as data (docs/table-7.md has the search).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace equipoise {

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

}  // namespace equipoise
