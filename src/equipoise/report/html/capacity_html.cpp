// Words and tables around the boundary.
#include "equipoise/report/html/capacity_html.hpp"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/html/cell_table.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/capacity_plots.hpp"
#include "equipoise/report/answers/quantities.hpp"
#include "equipoise/report/reports/result_tables.hpp"
#include "equipoise/report/text/cell_text.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/words/pages.hpp"

namespace equipoise {

namespace {

class CapacityDocument {
 public:
  CapacityDocument(const CapacityResult& result, const GivenMachine& machine) : r_(result), machine_(machine) {
    for (const auto& cell : r_.cells) done_ += cell.has_value();
  }

  Document make() {
    document_ = page_with(r_.study, answer_sentence(r_));
    add_missing_cells(document_, done_, r_.cells.size());
    if (done_ > 0) {
      picture();
      table();
    }
    add_machine(document_, machine_, words::pages::before_varied);
    origin();
    return std::move(document_);
  }

 private:
  void add(Block block) { document_.blocks.push_back(std::move(block)); }

  void picture() {
    add(Heading{2, r_.axes.empty() ? words::pages::how_often : words::pages::what_it_balances, ""});
    const std::string caption = r_.axes.empty() ? words::pages::share_at_values
                                                : fmt::format(words::pages::largest_at_which, key_words(r_.key),
                                                              100.0 * r_.at_least, r_.asked());
    add(drawn(capacity_plots(r_), capacity_title(r_), caption, true));
  }

  void table() {
    if (r_.axes.empty()) return table_of_trials();
    add_cell_table(document_, capacity_table(r_, key_words), words::pages::csv_holds_all);
  }

  void table_of_trials() {
    DocumentTable table{{column_title(key_words(r_.key), r_.unit), "balanced", "95 % interval", "undecided"}};
    for (const CapacityTrial& t : r_.cells.front()->trials) {
      std::vector<DocumentCell> row{number_cell(fmt::format("{:.6g}", t.value))};
      if (t.unstable)
        row.insert(row.end(), {number_cell("none"), {words::pages::no_state_attracts}, number_cell("-")});
      else
        row.insert(row.end(), {share_cell(t.balanced), number_cell(interval(t.balanced)), share_cell(t.undecided)});
      table.rows.push_back(std::move(row));
    }
    table.caption = words::pages::all_values_tried;
    add_cell_table(document_, std::move(table), words::pages::json_tells_all);
  }

  void origin() {
    add(Heading{2, words::pages::how_computed, ""});
    std::vector<std::string> set = keys_of(r_.axes);
    set.push_back(r_.key);
    std::string text = fmt::format(words::pages::values_halved, key_words(r_.key), r_.from, r_.to,
                                   r_.unit.empty() ? "" : " " + r_.unit, r_.precision * (r_.to - r_.from));
    if (!r_.axes.empty()) text += fmt::format("Varied: {}. ", varied_words(r_.axes));
    text += fmt::format(words::pages::starts_a_value, r_.starts, starts_words(r_.study, drawn_keys(r_.study, set)));
    text += model_words(r_.study, {r_.cpu_target, r_.threads, r_.seconds, r_.cpu_seconds});
    if (r_.resumed_trials > 0) text += fmt::format(words::pages::trials_from_file, r_.resumed_trials);
    add(Paragraph{text + "."});
    add_study(document_, r_.study);
  }

  const CapacityResult& r_;
  const GivenMachine& machine_;
  std::size_t done_ = 0;
  Document document_;
};

}  // namespace

std::string capacity_html(const CapacityResult& result, const GivenMachine& machine) {
  return document_html(CapacityDocument(result, machine).make());
}

}  // namespace equipoise
