// Capacities as text, JSON and CSV.
#include "equipoise/report/reports/reports.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/plain_number.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/reports/result_tables.hpp"
#include "equipoise/report/reports/sensitivity_report.hpp"
#include "equipoise/report/text/cell_text.hpp"
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

DocumentTable capacity_table(const CapacityResult& r, KeyWords words) {
  DocumentTable table;
  table.header = parameter_titles(r.axes, words);
  table.header.insert(table.header.end(),
                      {column_title(words(r.key), r.unit), "between", "undecided at most", "trials"});
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

std::string capacity_text(const CapacityResult& r, const TextStyle& style) {
  std::vector<std::string> set = keys_of(r.axes);
  set.push_back(r.key);
  std::string text = filled("answer   ", answer_sentence(r), style) + "\n";
  text += lines_filled(study_heading(r.study) + uncertain_text(r.study, set), style);
  text += lines_filled(fmt::format("The largest {} at which {:.4g} % of starts {}, searched from {}.\n\n", r.key,
                                   100.0 * r.at_least, r.asked(), sought_text(r)),
                       style);
  text += table_text(capacity_table(r, key_itself), style);
  std::string notes =
      fmt::format("Located to {}; a dip of the share between two of the values tried would be missed.\n",
                  in_unit(r, four_digits(r.precision * (r.to - r.from))));
  if (!r.complete()) notes += "PARTIAL: stopped before all cells were done.\n";
  if (r.resumed_trials > 0) notes += fmt::format("{} trials from an earlier run. ", r.resumed_trials);
  notes += fmt::format("{} starts a trial, seed {}, the same ones in all; {}; equipoise {}\n", r.starts,
                       r.study.sampling.seed, computed_text(r), version_string);
  return text + lines_filled(notes, style);
}

std::string capacity_json(const CapacityResult& r) {
  Json cells = Json::array(), open_cells = Json::array();
  const auto trial = [](const CapacityTrial& t) {
    Json one = object("value", t.value);
    one.update(Json(t.balanced));
    put(one, "undecided", t.undecided.share, "unstable", t.unstable);
    return one;
  };
  visit_done(r.cells, [&](std::size_t index, const CapacityCell& cell) {
    cells.push_back(object("at", at_json(r.axes, index), "value", cell.value, "low", cell.low, "high", cell.high,
                           "always", cell.always, "never", cell.never, "trials", list_of(cell.trials, trial)));
  });
  visit_done(r.open, [&](std::size_t index, const OpenCapacity& open) {
    open_cells.push_back(
        object("at", at_json(r.axes, index), "low", open.low, "high", open.high, "trials", open.trials));
  });
  Json json = object("of", r.key, "unit", r.unit, "at_least", r.at_least, "by", r.by, "from", r.from, "to", r.to,
                     "over", over_json(r.axes), "partial", !r.complete(), "cells", cells, "open", open_cells,
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
