// Computes the paper's tables row by row, reusing rows that an earlier run stored.
// This room: the paper computed again, and judged.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/extras/literature/reproduction.hpp"
#include "equipoise/extras/reproduction/reproduction.hpp"

namespace equipoise {

/// Speed laws to compute ramps under. At constant speed there is no difference.
enum class LawChoice { published, kinematic, both };
inline constexpr std::array<const char*, 3> law_choice_names{"published", "kinematic", "both"};

/// Progress is in starts of all ensembles asked for, then in curves, pixels and starts of the other parts.
struct ReproduceOptions : RunOptions {
  std::vector<int> tables;  ///< 1 to 7
  LawChoice laws = LawChoice::both;
  std::uint64_t starts = 0;  ///< per row; 0: as many as in the paper
  /// Folder for a NetCDF file of every ensemble's outcomes; empty: none. Ensembles found there are reused or resumed.
  std::string folder;
  // Only for reproduce():
  std::vector<std::string> figures;  ///< among paper_figure_ids()
  bool future = false;               ///< the open questions
  int slice_pixels = 64;             ///< along each side of their basin slices
};

/// What can be reproduced: "table-1" to "table-7", the figures, "future", and "tables", "figures", "all".
std::vector<std::string> reproducible();
/// Options for these; empty: everything. Throws InputError for names that are not in reproducible().
ReproduceOptions options_for(const std::vector<std::string>& what);

/// Computes and judges the tables asked for. After a stop, missing rows are marked. Throws as basin() does.
std::vector<ReproducedTable> reproduce_tables(const ReproduceOptions& options);

/// Everything asked for, judged and summed up. The caller draws the pictures. After a stop the result is partial.
Reproduction reproduce(const ReproduceOptions& options);

}  // namespace equipoise
