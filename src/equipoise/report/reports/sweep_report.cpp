// Sweeps as text, JSON and CSV.
#include "equipoise/report/reports/reports.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/plural.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/reports/sensitivity_report.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/report/text/cell_text.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/csv.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

// Number of attractors with their own column in a terminal's table.
constexpr std::size_t most_columns = 4;  // beside balanced

struct SweepColumn {
  int id = 0;
  std::string title;
  double sum = 0.0, largest = 0.0;  // of its shares: sum over all cells, and largest in any cell
  std::size_t cells = 0;            // in which starts came to it
};

// "V2"; the second motion of that alias with its number: "V2 (2)".
std::string column_name(const SweepOutcome& o) {
  if (o.alias.empty()) return o.name;
  const std::size_t number = o.name.rfind(" (");
  return number == std::string::npos ? o.alias : o.alias + o.name.substr(number);
}

// Attractors that some start came to: balanced first, then by their shares over all cells. The rarest have no column.
struct Columns {
  explicit Columns(const SweepResult& r) {
    std::map<int, SweepColumn> all;
    visit_done(r.cells, [&](std::size_t, const SweepCell& cell) {
      if (cell.stalled && cell.stalled->count > 0) stalled = true;
      for (const SweepOutcome& o : cell.outcomes) {
        if (o.share.count == 0 || o.id == balanced_id) continue;
        SweepColumn& column = all[o.id];
        column = {o.id, column_name(o), column.sum + o.share.share, std::max(column.largest, o.share.share),
                  column.cells + 1};
      }
    });
    for (const auto& [id, column] : all) shown.push_back(column);
    std::stable_sort(shown.begin(), shown.end(), [](const auto& a, const auto& b) { return a.sum > b.sum; });
    tell_apart();
    if (shown.size() <= most_columns) return;
    others.assign(shown.begin() + most_columns, shown.end());
    shown.resize(most_columns);
  }

  std::vector<SweepColumn> shown, others;
  bool stalled = false;

 private:
  // Makes all column titles different.
  void tell_apart() {
    std::map<std::string, int> titles;
    for (const SweepColumn& column : shown) ++titles[column.title];
    for (SweepColumn& column : shown)
      if (titles[column.title] > 1) column.title += fmt::format(" #{}", column.id);
  }
};

// The motions in the last column, and their largest share in any cell.
std::string others_text(const Columns& columns) {
  constexpr std::size_t most_named = 6;
  if (columns.others.empty()) return "";
  std::string text;
  for (std::size_t k = 0; k < std::min(columns.others.size(), most_named); ++k) {
    const SweepColumn& c = columns.others[k];
    text += fmt::format("{}{}, {} at most, in {} cell{}", k ? "; " : "", c.title, percent(c.largest, 2), c.cells,
                        plural(c.cells));
  }
  const std::size_t unnamed = columns.others.size() - std::min(columns.others.size(), most_named);
  if (unnamed > 0) text += fmt::format("; {} more", unnamed);
  return fmt::format("Others: {} motion{}: {}.\n", columns.others.size(), plural(columns.others.size()), text);
}

const SweepOutcome* find(const SweepCell& cell, int id) {
  const auto at = std::find_if(cell.outcomes.begin(), cell.outcomes.end(), [&](const auto& o) { return o.id == id; });
  return at == cell.outcomes.end() ? nullptr : &*at;
}

// The rarest motions go first where the terminal is narrow, then what all cells have alike.
DocumentTable cells_table(const SweepResult& r, const Columns& columns) {
  const bool limits = std::any_of(r.cells.begin(), r.cells.end(), [](const auto& c) { return c && kept_share(*c); });
  DocumentTable table{parameter_titles(r.axes, key_itself)};
  const auto column = [&](bool there, const std::string& title) {
    if (there) table.header.push_back(title);
    return table.header.size() - 1;
  };
  const std::size_t starts = column(true, "starts");
  column(true, "balanced");
  column(limits, "keep all limits");
  const std::size_t motions = table.header.size();
  for (const SweepColumn& c : columns.shown) column(true, c.title);
  const std::size_t others = column(!columns.others.empty(), "others");
  const std::size_t stalled = column(columns.stalled, "stalled");
  column(true, "undecided");
  if (columns.stalled) table.spare.push_back(stalled);
  for (std::size_t k = 0; k < columns.shown.size(); ++k) table.spare.push_back(motions + k);
  if (!columns.others.empty()) table.spare.push_back(others);
  table.missed = table.spare.size();
  table.spare.push_back(starts);
  visit_done(r.cells, [&](std::size_t index, const SweepCell& cell) {
    std::vector<DocumentCell> row = parameter_values(r.axes, index);
    const auto put = [&](bool there, const std::string& text) {
      if (there) row.push_back(number_cell(text));
    };
    const auto share_of = [&](const SweepColumn& c) {
      const SweepOutcome* o = find(cell, c.id);
      return o ? o->share.share : 0.0;
    };
    put(true, fmt::format("{}", cell.starts));
    put(true, share_with_interval(cell.outcomes.front().share));
    put(limits, kept_share(cell) ? share_with_interval(*kept_share(cell)) : "-");
    for (const SweepColumn& c : columns.shown) put(true, find(cell, c.id) ? percent(share_of(c), 2) : "-");
    double rest = 0.0;
    for (const SweepColumn& c : columns.others) rest += share_of(c);
    put(!columns.others.empty(), rest > 0.0 ? percent(rest, 2) : "-");
    put(columns.stalled, cell.stalled ? percent(cell.stalled->share, 2) : "-");
    put(true, percent(cell.undecided.share, 2));
    table.rows.push_back(std::move(row));
  });
  return table;
}

// Lost starts, and the cells' notes.
std::string what_else(const SweepResult& r) {
  std::string text;
  std::uint64_t lost = 0;
  visit_done(r.cells, [&](std::size_t index, const SweepCell& cell) {
    lost += cell.lost();
    if (!cell.note.empty()) text += fmt::format("Note at {}: {}.\n", cell_title(r.axes, index), cell.note);
  });
  return lost > 0 ? fmt::format("{} starts diverged or failed.\n", lost) + text : text;
}

Json transients_json(const TransientGroup& group) {
  Json transients = Json::object();
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    if (!group.tells(k)) continue;
    const SampleSummary& s = group.figures[k];
    Json& figure = transients[transient_figures[k].name] = object("mean", s.mean, "largest", s.largest);
    for (std::size_t q = 0; q < reported_quantiles.size(); ++q) {
      Json& quantile = figure["quantiles"][q] = object("at", reported_quantiles[q]);
      quantile.update(Json(s.quantiles[q]));
    }
  }
  const auto told = [](const Share& s) { return Json(s); };
  if (Json exceeded = by_name(group.exceeded, transient_limits, told); !exceeded.empty())
    put(transients, "exceeded", exceeded);
  if (Json within = by_name(group.within, within_names, sure); !within.empty()) put(transients, "within", within);
  return transients;
}

Json cell_json(const SweepResult& r, std::size_t index, const SweepCell& cell) {
  Json one = object("at", at_json(r.axes, index), "starts", cell.starts);
  one["outcomes"] = list_of(cell.outcomes, [](const SweepOutcome& o) {
    Json outcome = outcome_with(o, sure(o.share));
    put(outcome, "mean_time", o.mean_time, "radial", extremes(o.r_min, o.r_mean, o.r_max), "period",
        o.period > 0.0 ? Json(o.period) : Json());
    if (!o.unbalance.empty())
      put(outcome, "left_unbalance", object("probability", unbalance_quantiles, "unbalance", o.unbalance));
    return outcome;
  });
  for (const OutcomeShare& o : cell.others()) {
    if (o.id == undecided_code && cell.passed) put(one, "passed", sure(*cell.passed));
    one[o.name] = sure(o.share);
  }
  if (cell.transients) put(one, "transients", transients_json(*cell.transients));
  put(one, "balanced_stable", cell.balanced_stable, "note", cell.note);
  return one;
}

}  // namespace

std::string sweep_text(const SweepResult& r, const TextStyle& style) {
  const Columns columns(r);
  std::string text = filled("answer   ", answer_sentence(r), style) + "\n";
  text += lines_filled(study_heading(r.study) + uncertain_text(r.study, keys_of(r.axes)), style);
  text += table_text(cells_table(r, columns), style) + "\n";
  std::string notes = "Behind ± or in brackets: 95 % intervals.\n" + others_text(columns) + what_else(r);
  std::size_t done = 0;
  std::uint64_t starts = 0;
  visit_done(r.cells, [&](std::size_t, const SweepCell& cell) { ++done, starts += cell.starts; });
  if (done < r.cells.size())
    notes += fmt::format("PARTIAL: {} of {} cells; the rest is missing.\n", done, r.cells.size());
  notes += fmt::format("{} cell{}, {} starts, seed {}, the same starts in every cell", done, plural(done), starts,
                       r.study.sampling.seed);
  if (r.resumed_cells > 0)
    notes += fmt::format("; {} cell{} from an earlier run", r.resumed_cells, plural(r.resumed_cells));
  if (r.seconds > 0.0) notes += "; " + computed_text(r);
  return text + lines_filled(notes + fmt::format("; equipoise {}\n", version_string), style);
}

std::string sweep_json(const SweepResult& r) {
  Json cells = Json::array();
  visit_done(r.cells, [&](std::size_t index, const SweepCell& cell) { cells.push_back(cell_json(r, index, cell)); });
  Json json = object("over", over_json(r.axes), "zipped", r.axes.size() == 1 && r.axes.front().parameters.size() > 1,
                     "partial", !r.complete(), "cells", cells, "confidence", 0.95, "half_width", r.half_width,
                     "resumed_cells", r.resumed_cells);
  add_computed(json, r);
  return json.dump(2) + "\n";
}

std::string sweep_csv(const SweepResult& r) {
  std::string text =
      fmt::format("# equipoise {}: sweep{}\n", version_string, r.complete() ? "" : ", PARTIAL: cells are missing");
  text += csv_study(r.study) + csv_titles(r.axes);
  text += "starts,id,name,alias,kind,count,share,low,high";
  for (const MotionColumn& c : motion_columns) text += std::string(",") + c.name;
  text += "\n";
  visit_done(r.cells, [&](std::size_t index, const SweepCell& cell) {
    const std::string at = csv_values(r.axes, index);
    const auto line = [&](const OutcomeShare& o, const std::string& motion) {
      const Share& s = o.share;
      text += fmt::format("{}{},{},{},{},{},{},{},{},{}{}\n", at, cell.starts, o.id, csv_text(o.name),
                          csv_text(o.alias), csv_text(o.kind), s.count, s.share, s.low, s.high, motion);
    };
    for (const SweepOutcome& o : cell.outcomes) {
      std::string motion;
      for (const MotionColumn& c : motion_columns) motion += "," + csv_number(c.value(o).value_or(NAN));
      line(o, motion);
    }
    for (const OutcomeShare& o : cell.others()) line(o, std::string(motion_columns.size(), ','));
  });
  return text;
}

}  // namespace equipoise
