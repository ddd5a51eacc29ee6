// Capacities as a document, JSON and CSV.
#include "equipoise/report/reports/reports.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/csv.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

std::string four_digits(double value) { return plain_number(value, 4); }

std::string in_unit(const CapacityResult& r, const std::string& value) {
  return r.unit.empty() ? value : value + " " + r.unit;
}

// "20 to 400 g mm"
std::string sought_text(const CapacityResult& r) {
  return in_unit(r, fmt::format("{} to {}", four_digits(r.from), four_digits(r.to)));
}

// "213", "above 400", "below 20".
std::string capacity_value_text(const CapacityResult& r, const CapacityCell& cell) {
  if (cell.never) return "below " + four_digits(r.from);
  if (cell.always) return "above " + four_digits(r.to);
  return four_digits(*cell.value);
}

}  // namespace

DocumentTable capacity_table(const CapacityResult& r) {
  DocumentTable table;
  table.header = parameter_titles(r.axes);
  table.header.insert(table.header.end(), {column_title(r.key, r.unit), "between", "undecided at most", "trials"});
  table.spare = {table.header.size() - 1};
  table.caption =
      "Between: at the first value the share is large enough with 95 % confidence, however the undecided starts end; "
      "at the second it is too small with 95 % confidence.";
  bool unknown = false;
  const auto end = [&](const std::optional<double>& value) {
    unknown = unknown || !value;
    return value ? four_digits(*value) : std::string("?");
  };
  for (std::size_t index = 0; index < r.cells.size(); ++index) {
    const auto add_row = [&](const std::string& value, const OpenCapacity& of, const std::string& undecided) {
      std::vector<DocumentCell> row = parameter_values(r.axes, index);
      for (const std::string& text :
           {value, fmt::format("{} and {}", end(of.low), end(of.high)), undecided, fmt::format("{}", of.trials)})
        row.push_back(number_cell(text));
      table.rows.push_back(std::move(row));
    };
    if (const auto& open = r.open[index]) add_row("open", *open, "-");
    if (!r.cells[index]) continue;
    const CapacityCell& cell = *r.cells[index];
    Share open;
    for (const CapacityTrial& t : cell.trials)
      if (t.undecided.share >= open.share) open = t.undecided;
    add_row(capacity_value_text(r, cell), {cell.shown_low(r.at_least), cell.shown_high(r.at_least), cell.trials.size()},
            share_cell(open).text);
  }
  if (!r.complete()) table.caption += " Of an open one the capacity is not known between the two values.";
  if (unknown) table.caption += " ?: no value tried says so.";
  return table;
}

namespace {

// The values that were tried, of a capacity alone.
DocumentTable table_of_trials(const CapacityResult& r) {
  DocumentTable table{{column_title(r.key, r.unit), r.asked(), "95 % interval", "undecided"}};
  for (const CapacityTrial& t : r.cells.front()->trials) {
    std::vector<DocumentCell> row{number_cell(fmt::format("{:.6g}", t.value))};
    if (t.unstable)
      row.insert(row.end(), {number_cell("none"), {"no balanced state attracts"}, number_cell("-")});
    else
      row.insert(row.end(), {share_cell(t.balanced), number_cell(interval(t.balanced)), share_cell(t.undecided)});
    table.rows.push_back(std::move(row));
  }
  table.caption = "All values that were tried.";
  return table;
}

}  // namespace

Document document_of(const CapacityResult& r) {
  std::vector<std::string> set = keys_of(r.axes);
  set.push_back(r.key);
  Document document = document_with(r.study, answer_sentence(r), uncertain_text(r.study, set));
  if (!r.complete()) document.add(Paragraph{"PARTIAL: stopped before all cells were done.", Tone::bad});
  const std::string question = fmt::format("The largest {} at which {:.4g} % of starts {}, searched from {}.", r.key,
                                           100.0 * r.at_least, r.asked(), sought_text(r));
  document.add(Paragraph{question});
  const bool any = std::any_of(r.cells.begin(), r.cells.end(), [](const auto& cell) { return cell.has_value(); });
  if (any) {
    document.add(Heading{2, r.axes.empty() ? "Starts that " + r.asked() : "The largest " + key_words(r.key), ""});
    DrawingRow row =
        drawn(capacity_plots(r),
              r.axes.empty()
                  ? fmt::format("Share of the starts that {} at every value tried, with its 95 % interval.", r.asked())
                  : "A stroke is a 95 % interval: below its lower end the share is shown to be large "
                    "enough, above its upper end it is shown to be too small.");
    row.details = question + (r.complete() ? "" : " PARTIAL: stopped early.");
    document.add(std::move(row));
  }
  document.add(capacity_table(r));
  if (any && r.axes.empty()) document.add(table_of_trials(r));
  std::string words = fmt::format(
      "Values of {} in steps of an eighth of the range until one is shown to be too large, then halved to {}; a dip of "
      "the share between two of them would be missed.",
      key_words(r.key), in_unit(r, four_digits(r.precision * (r.to - r.from))));
  if (!r.axes.empty()) words += fmt::format(" Varied: {}.", varied_words(r.axes));
  words += fmt::format(" {} starts per trial {}, the same in all.", r.starts,
                       starts_words(r.study, drawn_keys(r.study, set)));
  if (r.resumed_trials > 0) words += fmt::format(" {} trials from an earlier run.", r.resumed_trials);
  add_origin(document, r.study, words, computed_text(r));
  return document;
}

void to_json(Json& json, const CapacityTrial& t) {
  json = object("value", t.value);
  json.update(Json(t.balanced));
  put(json, "undecided", t.undecided.share, "unstable", t.unstable);
}

std::string json_text(const CapacityResult& r) {
  Json cells = Json::array(), open_cells = Json::array();
  visit_done(r.cells, [&](std::size_t index, const CapacityCell& cell) {
    cells.push_back(object("at", PartOf{index, r.axes}, "value", cell.value, "low", cell.low, "high", cell.high,
                           "always", cell.always, "never", cell.never, "trials", cell.trials));
  });
  visit_done(r.open, [&](std::size_t index, const OpenCapacity& open) {
    open_cells.push_back(
        object("at", PartOf{index, r.axes}, "low", open.low, "high", open.high, "trials", open.trials));
  });
  Json json = object("of", r.key, "unit", r.unit, "at_least", r.at_least, "by", r.by, "from", r.from, "to", r.to,
                     "over", parameters_of(r.axes), "partial", !r.complete(), "cells", cells, "open", open_cells,
                     "confidence", 0.95, "starts", r.starts, "resumed_trials", r.resumed_trials);
  add_computed(json, r);
  return json.dump(2) + "\n";
}

std::string capacity_csv(const CapacityResult& r) {
  std::string text = fmt::format(
      "# equipoise {}: largest {} at which a share of {} of {} starts {}, searched from {}{}\n", version_string, r.key,
      r.at_least, r.starts, r.asked_of_one(), sought_text(r), r.complete() ? "" : ", PARTIAL");
  text += csv_study(r.study) + csv_titles(r.axes) + csv_title(r.key, r.unit) + ",low,high,always,never,trials\n";
  visit_done(r.cells, [&](std::size_t index, const CapacityCell& cell) {
    text += csv_values(r.axes, index);
    text += fmt::format("{},{},{},{:d},{:d},{}\n", csv_number(cell.value.value_or(NAN)), cell.low, cell.high,
                        cell.always, cell.never, cell.trials.size());
  });
  return text;
}

}  // namespace equipoise
