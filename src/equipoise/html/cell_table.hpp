// Tables of cells in pages, limited to what two sheets of paper hold.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/drawing/document.hpp"
#include "equipoise/results/sweep_result.hpp"

namespace equipoise {

/// Columns for the parameters of all axes: titles, and a cell's values.
std::vector<std::string> parameter_titles(const std::vector<SweepAxis>& axes);
std::vector<DocumentCell> parameter_values(const std::vector<SweepAxis>& axes, std::size_t cell);

/// Adds a table with one row per cell: open if short, else folded, cut off if very long. `all`: where all cells are.
void add_cell_table(Document& document, DocumentTable table, const std::string& all);

/// "final speed from 1.5 to 6 (46 values); ball drag 0.05, 0.1": what varies.
std::string varied_words(const std::vector<SweepAxis>& axes);

}  // namespace equipoise
