// The fitted readings, read from their CSV file.
#include "equipoise/literature/table_7_candidates.hpp"

#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

#include "equipoise/literature/paper_files.hpp"
#include "equipoise/base/error.hpp"

namespace equipoise {

namespace {

// Columns: protocol (quoted: it holds commas), test_origin, test_offset, span, tolerance, four shares, starts, chi2,
// fitted_numbers, free_cells, role.
Table7Candidate candidate(const std::string& line) {
  const std::size_t end = line.find('"', 1);
  Table7Candidate c;
  c.protocol = line.substr(1, end - 1);
  std::istringstream rest(line.substr(end + 2));
  std::vector<std::string> cells;
  for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
  const auto number = [&](std::size_t k) { return std::strtod(cells.at(k).c_str(), nullptr); };
  const std::string when = cells.at(0) == "t" ? "t = " + cells.at(1) : cells.at(0) + " " + cells.at(1);
  c.test = number(2) > 0.0 ? fmt::format("r < {:.3g} for {} up to {}", number(3), cells.at(2), when)
                           : fmt::format("r < {:.3g} at {}", number(3), when);
  for (std::size_t k = 0; k < 4; ++k) c.percent[k] = number(4 + k);
  c.starts = static_cast<std::uint64_t>(number(8));
  c.chi_squared = number(9);
  c.fitted = static_cast<int>(number(10));
  c.free_cells = static_cast<int>(number(11));
  c.best = cells.at(12) == "best lead";
  return c;
}

}  // namespace

std::vector<Table7Candidate> table_7_candidates() {
  const std::string_view text = embedded::paper_files.find("evidence/table-7-candidates.csv");
  if (text.empty()) throw RunError("evidence/table-7-candidates.csv: the library was built without it");
  std::istringstream file{std::string(text)};
  std::vector<Table7Candidate> list;
  for (std::string line; std::getline(file, line);)
    if (line.starts_with('"')) list.push_back(candidate(line));
  return list;
}

}  // namespace equipoise
