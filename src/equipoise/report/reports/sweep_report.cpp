// Sweeps as a document, JSON and CSV.
#include "equipoise/report/reports/reports.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/csv.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

// Number of attractors with their own column in a terminal's table.
constexpr std::size_t most_columns = 4;  // next to balanced

struct SweepColumn {
  int id = 0;
  std::string title;
  double sum = 0.0, largest = 0.0;  // of its shares: sum over all cells, and largest in any cell
  std::size_t cells = 0;            // in which starts ended in it
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
  return fmt::format("Others: {} motion{}: {}.", columns.others.size(), plural(columns.others.size()), text);
}

const SweepOutcome* find(const SweepCell& cell, int id) {
  const auto at = std::find_if(cell.outcomes.begin(), cell.outcomes.end(), [&](const auto& o) { return o.id == id; });
  return at == cell.outcomes.end() ? nullptr : &*at;
}

// What the cells have in all.
struct Totals {
  explicit Totals(const SweepResult& r) {
    visit_done(r.cells, [&](std::size_t, const SweepCell& cell) {
      ++done;
      starts += cell.starts;
      least_starts = std::min(least_starts, cell.starts);
      most_starts = std::max(most_starts, cell.starts);
      lost += cell.lost();
      open = open || cell.undecided.count > 0;
      limits = limits || kept_share(cell);
    });
  }
  std::size_t done = 0;
  std::uint64_t starts = 0, least_starts = ~std::uint64_t{0}, most_starts = 0, lost = 0;
  bool open = false, limits = false;
};

// Only limits on what happens on the way.
bool shows(const SweepResult& r, const TransientLimit& l) {
  return r.transients && !l.at_end && r.study.limits.*l.limit;
}

// If there is little room, what most cells have alike goes first, then the rarest motions.
DocumentTable cells_table(const SweepResult& r, const Columns& columns, const Totals& totals) {
  DocumentTable table{parameter_titles(r.axes)};
  std::vector<std::size_t> ends, motions, alike;
  const auto column = [&](const std::string& title, std::vector<std::size_t>* spare = nullptr) {
    if (spare) spare->push_back(table.header.size());
    table.header.push_back(title);
  };
  column("starts", &alike);
  column("balanced");
  if (totals.open) column("bounds", &alike);
  if (totals.limits) column("keep all limits");
  for (const SweepColumn& c : columns.shown) column(c.title, &motions);
  if (!columns.others.empty()) column("others", &motions);
  if (columns.stalled) column("stalled", &ends);
  column("undecided");
  const PageQuantities shown(r.study);
  for (const TransientLimit& l : transient_limits)
    if (shows(r, l)) column("above " + shown.text(*(r.study.limits.*l.limit), l.told_in()), &ends);
  table.spare = ends;
  table.spare.insert(table.spare.end(), motions.begin(), motions.end());
  table.missed = table.spare.size();
  table.spare.insert(table.spare.end(), alike.rbegin(), alike.rend());
  visit_done(r.cells, [&](std::size_t index, const SweepCell& cell) {
    std::vector<DocumentCell> row = parameter_values(r.axes, index);
    const auto put = [&](const std::string& text) { row.push_back(number_cell(text)); };
    const auto share_of = [&](const SweepColumn& c) {
      const SweepOutcome* o = find(cell, c.id);
      return o ? o->share.share : 0.0;
    };
    const Share& balanced = cell.outcomes.front().share;
    put(fmt::format("{}", cell.starts));
    put(share_with_interval(balanced));
    if (totals.open) put(bounds_text(balanced));
    if (totals.limits) put(kept_share(cell) ? share_with_interval(*kept_share(cell)) : "-");
    for (const SweepColumn& c : columns.shown) put(find(cell, c.id) ? percent(share_of(c), 2) : "-");
    double rest = 0.0;
    for (const SweepColumn& c : columns.others) rest += share_of(c);
    if (!columns.others.empty()) put(rest > 0.0 ? percent(rest, 2) : "-");
    if (columns.stalled) put(cell.stalled ? percent(cell.stalled->share, 2) : "-");
    put(percent(cell.undecided.share, 2));
    for (std::size_t k = 0; k < transient_limits.size(); ++k) {
      if (!shows(r, transient_limits[k])) continue;
      const auto& exceeded = cell.transients->exceeded[k];
      row.push_back(exceeded ? share_cell(*exceeded) : number_cell("-"));
    }
    table.rows.push_back(std::move(row));
  });
  table.caption = "Behind ± or in brackets: 95 % intervals.";
  if (totals.open)
    table.caption += " Intervals hold only if the undecided starts end elsewhere; bounds hold however they end.";
  return table;
}

// A note that many cells share appears once.
void add_notes(Document& document, const SweepResult& r) {
  struct Note {
    std::string text, at;
    std::size_t cells;
  };
  std::vector<Note> notes;
  visit_done(r.cells, [&](std::size_t index, const SweepCell& cell) {
    if (cell.note.empty()) return;
    const auto same = std::find_if(notes.begin(), notes.end(), [&](const Note& n) { return n.text == cell.note; });
    if (same == notes.end())
      notes.push_back({cell.note, cell_title(r.axes, index), 1});
    else
      ++same->cells;
  });
  constexpr std::size_t most = 4;
  for (std::size_t k = 0; k < std::min(notes.size(), most); ++k) {
    const Note& note = notes[k];
    const std::string more =
        note.cells > 1 ? fmt::format(" and {} more cell{}", note.cells - 1, plural(note.cells - 1)) : "";
    document.add(Paragraph{fmt::format("Note at {}{}: {}.", note.at, more, note.text), Tone::open});
  }
  if (notes.size() > most)
    document.add(Paragraph{fmt::format("{} more notes of single cells are in --json.", notes.size() - most)});
}

}  // namespace

// Of a cell, dimensionless.
void to_json(Json& json, const TransientGroup& group) {
  json = Json::object();
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    if (!group.tells(k)) continue;
    const SampleSummary& s = group.figures[k];
    Json& figure = json[transient_figures[k].name] = object("mean", s.mean, "largest", s.largest);
    for (std::size_t q = 0; q < reported_quantiles.size(); ++q) {
      Json& quantile = figure["quantiles"][q] = object("at", reported_quantiles[q]);
      quantile.update(Json(s.quantiles[q]));
    }
  }
  const auto told = [](const Share& s) { return Json(s); };
  if (Json exceeded = by_name(group.exceeded, transient_limits, told); !exceeded.empty())
    put(json, "exceeded", exceeded);
  if (Json within = by_name(group.within, within_names, sure); !within.empty()) put(json, "within", within);
}

void to_json(Json& json, const SweepOutcome& o) {
  json = outcome_with(o, sure(o.share));
  put(json, "mean_time", o.mean_time, "radial", extremes(o.r_min, o.r_mean, o.r_max), "period",
      o.period > 0.0 ? Json(o.period) : Json());
  if (!o.unbalance.empty())
    put(json, "left_unbalance", object("probability", unbalance_quantiles, "unbalance", o.unbalance));
}

void to_json(Json& json, const SweepCell& cell) {
  json = object("starts", cell.starts, "outcomes", cell.outcomes);
  for (const OutcomeShare& o : cell.others()) {
    if (o.id == undecided_code && cell.passed) put(json, "passed", sure(*cell.passed));
    json[o.name] = sure(o.share);
  }
  if (cell.transients) put(json, "transients", *cell.transients);
  put(json, "balanced_stable", cell.balanced_stable, "note", cell.note);
}

Document document_of(const SweepResult& r) {
  const Columns columns(r);
  const Totals totals(r);
  Document document = document_with(r.study, answer_sentence(r), uncertain_text(r.study, keys_of(r.axes)));
  if (totals.done < r.cells.size())
    document.add(Paragraph{fmt::format("PARTIAL: {} of {} cells; the rest is missing.", totals.done, r.cells.size()),
                           Tone::bad});
  if (totals.done > 0) {
    document.add(Heading{2, "Where starts end", ""});
    document.add(sweep_drawing(r));
    if (const auto peaks = peak_plot(r))
      document.add(DrawingRow{{{"Peak displacement on the way", plot_svg(*peaks, "Peaks along the parameter"), "", ""}},
                              "With 95 % intervals.",
                              DrawingSize::wide});
    document.add(cells_table(r, columns, totals));
  }
  if (const std::string others = others_text(columns); !others.empty()) document.add(Paragraph{others});
  if (totals.lost > 0) document.add(Paragraph{fmt::format("{} starts diverged or failed.", totals.lost), Tone::open});
  add_notes(document, r);
  std::string words = fmt::format("Varied: {}.", varied_words(r.axes));
  if (totals.done > 0) {
    const std::string each = totals.least_starts == totals.most_starts
                                 ? fmt::format("{} starts", totals.most_starts)
                                 : fmt::format("{} to {} starts", totals.least_starts, totals.most_starts);
    words += fmt::format(
        " {} cell{} with {} each ({} in all) {}, the same in every cell, each followed until it is known where it "
        "ends.",
        totals.done, plural(totals.done), each, totals.starts,
        starts_words(r.study, drawn_keys(r.study, keys_of(r.axes))));
  }
  if (r.half_width > 0.0)
    words += fmt::format(" Sampled until every share was known to +- {:.3g} %.", 100.0 * r.half_width);
  if (r.resumed_cells > 0)
    words += fmt::format(" {} cell{} from an earlier run.", r.resumed_cells, plural(r.resumed_cells));
  add_origin(document, r.study, words, r.seconds > 0.0 ? computed_text(r) : "");
  return document;
}

std::string json_text(const SweepResult& r) {
  Json cells = Json::array();
  visit_done(r.cells, [&](std::size_t index, const SweepCell& cell) {
    cells.push_back(object("at", PartOf{index, r.axes}));
    cells.back().update(Json(cell));
  });
  Json json = object("over", parameters_of(r.axes), "zipped",
                     r.axes.size() == 1 && r.axes.front().parameters.size() > 1, "partial", !r.complete(), "cells",
                     cells, "confidence", 0.95, "half_width", r.half_width, "resumed_cells", r.resumed_cells);
  add_computed(json, r);
  return json.dump(2) + "\n";
}

std::string sweep_csv(const SweepResult& r) {
  std::string text =
      fmt::format("# equipoise {}: sweep{}\n", version_string, r.complete() ? "" : ", PARTIAL: cells are missing");
  text += csv_study(r.study) + csv_titles(r.axes);
  text += "starts,id,name,alias,kind,count,share,low,high" + csv_names(motion_columns) + "\n";
  visit_done(r.cells, [&](std::size_t index, const SweepCell& cell) {
    const std::string at = csv_values(r.axes, index);
    const auto line = [&](const OutcomeShare& o, const std::string& motion) {
      const Share& s = o.share;
      text += fmt::format("{}{},{},{},{},{},{},{},{},{}{}\n", at, cell.starts, o.id, csv_text(o.name),
                          csv_text(o.alias), csv_text(o.kind), s.count, s.share, s.low, s.high, motion);
    };
    for (const SweepOutcome& o : cell.outcomes) line(o, csv_numbers(motion_columns, o));
    for (const OutcomeShare& o : cell.others()) line(o, std::string(motion_columns.size(), ','));
  });
  return text;
}

}  // namespace equipoise
