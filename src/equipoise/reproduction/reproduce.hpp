// The paper's tables computed row by row, with rows that an earlier run stored taken from there.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/literature/reproduction.hpp"
#include "equipoise/reproduction/reproduction.hpp"
#include "equipoise/running/run_options.hpp"

namespace equipoise {

/// Which speed laws to compute ramps under. Constant speeds know no difference.
enum class LawChoice { published, kinematic, both };
inline constexpr std::array<const char*, 3> law_choice_names{"published", "kinematic", "both"};

/// Progress is in starts of all ensembles asked for; then in curves, pixels and starts of what else is.
struct ReproduceOptions : RunOptions {
  std::vector<int> tables;  ///< 1 to 7
  LawChoice laws = LawChoice::both;
  std::uint64_t starts = 0;  ///< a row; 0: as many as the paper used
  /// Folder for a NetCDF file of every ensemble's outcomes; empty: none. Ensembles found there are used or resumed.
  std::string folder;
  // For reproduce() alone.
  std::vector<std::string> figures;  ///< of paper_figure_ids()
  bool future = false;               ///< the open questions
  int slice_pixels = 64;             ///< along each side of their maps
};

/// What there is to be reproduced: "table-1" to "table-7", the figures, "future", and "tables", "figures", "all".
std::vector<std::string> reproducible();
/// Options that ask for these; none: all. Throws InputError for what is not among reproducible().
ReproduceOptions options_for(const std::vector<std::string>& what);

/// Computes and judges the tables asked for. After a stop, rows not done are marked so. Throws as basin() does.
std::vector<ReproducedTable> reproduce_tables(const ReproduceOptions& options);

/// All that is asked for, judged and added up. Pictures are for the caller to draw. After a stop the result is partial.
Reproduction reproduce(const ReproduceOptions& options);

}  // namespace equipoise
