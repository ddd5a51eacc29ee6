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
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/answers/quantities.hpp"
#include "equipoise/report/reports/result_tables.hpp"
#include "equipoise/report/text/cell_text.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"

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
    add_machine(document_, machine_, "in the study, before anything is varied");
    origin();
    return std::move(document_);
  }

 private:
  void add(Block block) { document_.blocks.push_back(std::move(block)); }

  void picture() {
    add(Heading{2, r_.axes.empty() ? "How often it balances" : "What it balances", ""});
    const std::string caption =
        r_.axes.empty() ? "Share of the starts that ends balanced at every value tried, with its 95 % interval."
                        : fmt::format(
                              "The largest {} at which {:.4g} % of starts {}. A stroke is its 95 % interval: below its "
                              "lower end that is shown, above its upper end it is shown to fail.",
                              key_words(r_.key), 100.0 * r_.at_least, r_.asked());
    add(drawn(capacity_plots(r_), capacity_title(r_), caption, true));
  }

  void table() {
    if (r_.axes.empty()) return table_of_trials();
    add_cell_table(document_, capacity_table(r_, key_words), "the CSV file holds all of them");
  }

  void table_of_trials() {
    DocumentTable table{{column_title(key_words(r_.key), r_.unit), "balanced", "95 % interval", "undecided"}};
    for (const CapacityTrial& t : r_.cells.front()->trials) {
      std::vector<DocumentCell> row{number_cell(fmt::format("{:.6g}", t.value))};
      if (t.unstable)
        row.insert(row.end(), {number_cell("none"), {"no balanced state attracts"}, number_cell("-")});
      else
        row.insert(row.end(), {share_cell(t.balanced), number_cell(interval(t.balanced)), share_cell(t.undecided)});
      table.rows.push_back(std::move(row));
    }
    table.caption = "All values that were tried.";
    add_cell_table(document_, std::move(table), "the JSON answer tells all of them");
  }

  void origin() {
    add(Heading{2, "How it was computed", ""});
    std::vector<std::string> set = keys_of(r_.axes);
    set.push_back(r_.key);
    std::string text = fmt::format(
        "Values of {} from {:.4g} to {:.4g}{} in steps of an eighth of that until one is shown to be too large, then "
        "halved to {:.3g}; a dip of the share between two of them would be missed. ",
        key_words(r_.key), r_.from, r_.to, r_.unit.empty() ? "" : " " + r_.unit, r_.precision * (r_.to - r_.from));
    if (!r_.axes.empty()) text += fmt::format("Varied: {}. ", varied_words(r_.axes));
    text += fmt::format("{} starts a value {}, the same in all.", r_.starts,
                        starts_words(r_.study, drawn_keys(r_.study, set)));
    text += model_words(r_.study, {r_.cpu_target, r_.threads, r_.seconds, r_.cpu_seconds});
    if (r_.resumed_trials > 0) text += fmt::format("; {} trials from an earlier run's file", r_.resumed_trials);
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
