// Short tables as they are, long ones folded.
#include "equipoise/report/html/cell_table.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/report/answers/quantities.hpp"

namespace equipoise {

void add_cell_table(Document& document, DocumentTable table, const std::string& all) {
  constexpr std::size_t short_enough = 40, most = 5000;
  const std::size_t rows = table.rows.size();
  table.folded = rows > short_enough;
  if (rows > most) {
    table.rows.resize(most);
    document.blocks.push_back(Paragraph{fmt::format("The table ends after {} of {} cells; {}.", most, rows, all)});
  }
  if (table.folded)
    table.caption = fmt::format("All {} cells{}{}", rows, table.caption.empty() ? "" : ". ", table.caption);
  document.blocks.push_back(std::move(table));
}

std::string varied_words(const std::vector<SweepAxis>& axes) {
  constexpr std::size_t few = 6;
  std::string text;
  visit_parameters(axes, 0, [&](const SweepParameter& p, std::size_t) {
    const std::size_t count = p.given.size();
    text += text.empty() ? "" : "; ";
    text += count <= few
                ? fmt::format("{} {}", key_words(p.key), fmt::join(p.given, ", "))
                : fmt::format("{} from {} to {} ({} values)", key_words(p.key), p.given.front(), p.given.back(), count);
  });
  return text;
}

}  // namespace equipoise
