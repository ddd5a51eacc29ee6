// Tables of cells in pages, limited to what two sheets of paper hold.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

/// Puts a table with a row a cell where it belongs: open where it is short, else folded, and cut where it is endless.
/// `all`: where all cells are to be had.
void add_cell_table(Document& document, DocumentTable table, const std::string& all);

/// "final speed from 1.5 to 6 (46 values); ball drag 0.05, 0.1": what varies.
std::string varied_words(const std::vector<SweepAxis>& axes);

}  // namespace equipoise
