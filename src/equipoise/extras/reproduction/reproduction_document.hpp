// The reproduced paper as a report: its blocks, plots, words and numbers.
#pragma once

#include <string>

#include "equipoise/extras/reproduction/reproduction.hpp"
#include "equipoise/report/drawing/document.hpp"

namespace equipoise {

/// Each drawing stands below a heading whose anchor names it ("table-3", "figure-transients"). `explorer`: address of
/// the explorer's page, to which every row's study then links; may be empty.
Document reproduction_document(const Reproduction& r, const std::string& explorer = "");

/// A share in percent without the sign, with as many digits as in print or as small counts need: "60.40".
std::string percentage(const Share& s);
/// The words for a cell in tables: "-" or nothing if it was not computed. Printed fractions of one are converted to
/// percentages and marked.
struct CellWords {
  std::string printed, computed, interval, p_value, kinematic;
};
CellWords cell_words(const ReproducedRow& row, const ReproducedCell& cell);
/// Whether this is an attractor other than balance that was neither printed nor found.
bool is_idle(const ReproducedCell& cell);
/// "+19.8 (19.4 to 20.2)", in percentage points.
std::string difference_text(const ShareDifference& d);
/// "holds: +19.8 (19.4 to 20.2)"; with several contrasts the smallest and the largest.
std::string answer_text(const ConclusionResult& c);
/// Agreeing, differing and not comparable cells of all tables.
CellCounts all_cells(const Reproduction& r);

/// Shares of the motions of a basin slice, the largest first.
std::string codes_text(const BasinSlice& map);
/// What a slice over lambda and a ball's angle, or over lambda and mu, shows of the eccentricity that the balls
/// balance. Values are those of pixel centres. Empty for an incomplete slice.
std::string balanced_text(const BasinSlice& map);

}  // namespace equipoise
