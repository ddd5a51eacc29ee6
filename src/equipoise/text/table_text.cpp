// Columns of text.
#include "equipoise/text/table_text.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "equipoise/text/text.hpp"

namespace equipoise {

DocumentCell share_cell(const Share& s) { return number_cell(percent(s.share, s.count == 0 ? 0 : digits_for(s))); }

std::string table_text(const DocumentTable& table) {
  const std::size_t columns = table.header.size();
  std::vector<std::vector<DocumentCell>> rows{row_of(std::string(columns, 't'), table.header)};
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  std::vector<std::size_t> width(columns);
  std::vector<bool> right(columns);
  bool marked = false;
  for (const auto& row : rows) {
    marked = marked || row.front().tone == Tone::good;
    for (std::size_t k = 0; k < columns; ++k) {
      width[k] = std::max(width[k], row[k].text.size());
      right[k] = right[k] || row[k].number;
    }
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line = !marked ? "" : row.front().tone == Tone::good ? "* " : "  ";
    for (std::size_t k = 0; k < columns; ++k)
      line += (k ? "  " : "") + fmt::format(fmt::runtime(right[k] ? "{:>{}}" : "{:<{}}"), row[k].text, width[k]);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return table.caption.empty() ? text : text + table.caption + "\n";
}

}  // namespace equipoise
