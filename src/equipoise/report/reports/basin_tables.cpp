// The tables of an ensemble: figures against limits, outcomes, what balance depends on. Every number is one that its
// JSON has.
#include "equipoise/report/reports/basin_parts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/report/text/motion_words.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/results/commands/left_grade.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

namespace {
using study::Dimension;

std::string range_text(const Estimate& e) { return fmt::format("{:.2f} to {:.2f}", e.low, e.high); }
}  // namespace

std::string end_name(const BasinResult& r, const OutcomeShare& o) {
  return o.id == stalled_code
             ? "stalled below " + engineering(r.study.scales, r.study.stall_speed(), study::Dimension::speed)
             : o.name;
}

DocumentTable short_table(const BasinResult& r) {
  const Study& study = r.study;
  const TransientGroup& with = r.transients->groups.front();
  const OneBodyRuns* bare = tells_without_balls(r) ? &r.without_balls->bare : nullptr;
  // The least limit on a figure during start-up, or of the motion at the end, which has to stay below limits.settled.
  const auto limit_on = [&](float TransientRow::*figure, bool end) {
    std::optional<double> least;
    const auto consider = [&](const std::optional<double>& limit) {
      if (limit && !(least && *least <= *limit)) least = limit;
    };
    for (const TransientLimit& l : transient_limits)
      if (!l.by_speed && (end ? l.end == figure : !l.at_end && l.value == figure)) consider(study.limits.*l.limit);
    if (end && figure == &TransientRow::peak_radial_at_end) consider(study.limits.settled);
    return least;
  };
  const Limits& limits = study.limits;
  const bool limited = limits.settled || std::any_of(transient_limits.begin(), transient_limits.end(),
                                                     [&](const auto& l) { return !l.by_speed && limits.*l.limit; });
  const auto [before, after] = phase_words(study);
  std::vector<std::string> header{before};
  if (limited) header.emplace_back("limit");
  if (bare) header.emplace_back("no balls");
  header.insert(header.end(), {"with balls", "9 in 10 below"});
  if (limited) header.emplace_back("");
  DocumentTable table{header};
  const auto row = [&](const std::string& name, const std::vector<std::string>& figures, bool over) {
    std::vector<DocumentCell>& cells = table.rows.emplace_back();
    cells.push_back(label_cell(name));
    for (const std::string& text : figures) cells.push_back(number_cell(text));
    if (limited) cells.push_back({over ? "OVER" : "", Tone::bad});
    cells.resize(header.size());
  };
  const auto figure_row = [&](float TransientRow::*figure, bool end, const std::string& name) {
    const std::size_t k = figure_place(figure);
    const TransientFigure& f = transient_figures[k];
    if (!r.transients->asks(f, limits) || with.figures[k].count == 0) return;
    const study::ShownUnit unit = unit_of(study, f.told_in());
    const auto shown = [&](double value, const char* open) {
      return value == 0.0 ? std::string("0")
             : std::isfinite(value)
                 ? fmt::format("{:.3g}{}{}", value * unit.size, study.scales ? " " : "", study.scales ? unit.name : "")
                 : std::string(open);
    };
    const auto quantile = [&](const TransientGroup& group, std::size_t q) {
      return shown(group.figures[k].quantiles[q].value, f.open[group.for_good(f) > 0 ? 0 : 1]);
    };
    const std::optional<double> limit = limit_on(figure, end);
    std::vector<std::string> figures;
    if (limited) figures.push_back(limit ? shown(*limit, "-") : "-");
    if (bare)
      figures.push_back(f.of_bare_rotor && bare->figures.figures[k].count > 0 ? quantile(bare->figures, 0) : "-");
    for (const std::size_t q : {0, 1}) figures.push_back(quantile(with, q));
    row(name, figures, limit && with.figures[k].quantiles[1].value > *limit);
  };
  using Figure = float TransientRow::*;
  const auto figure_rows = [&](bool end, const std::vector<Figure>& usual) {
    for (const TransientFigure& f : transient_figures) {
      const bool wanted = std::find(usual.begin(), usual.end(), f.value) != usual.end() ||
                          (f.value != &TransientRow::settling_time && limit_on(f.value, end));
      if (wanted) figure_row(f.value, end, "  " + figure_name(f.value));
    }
  };
  figure_rows(false, {&TransientRow::peak_radial, &TransientRow::peak_force});
  row(after, {}, false);
  figure_rows(true, {&TransientRow::peak_radial_at_end, &TransientRow::rms_force, &TransientRow::rms_velocity});
  if (const auto grade = left_grade(with, study); bare && grade) {
    const auto without = left_grade(bare->figures, study);
    const double mm_per_s = unit_of(study, Dimension::velocity).size;
    const auto most = limits.grade ? std::optional(*limits.grade * mm_per_s) : std::nullopt;
    const auto shown = [](const std::optional<double>& g) { return g ? fmt::format("G {:.3g}", *g) : "-"; };
    std::vector<std::string> figures{shown(without), shown(grade)};
    if (limited) figures.insert(figures.begin(), shown(most));
    row("  balance quality, mean", figures, most && *grade > *most);
  }
  figure_row(&TransientRow::settling_time, true, "settled after");
  return table;
}

DocumentTable outcome_table(const BasinResult& r, bool brief) {
  constexpr std::size_t most = 6;
  const bool even = r.study.sampling.method.value_or(SamplingMethod::random) != SamplingMethod::random;
  const bool open = r.undecided.count > 0, physical = r.study.scales.has_value();
  const TransientResult* t = r.transients ? &*r.transients : nullptr;
  const study::ShownUnit velocity = unit_of(r.study, Dimension::velocity), length = unit_of(r.study, Dimension::length);
  const bool full = !brief, graded = full && t && is_graded(r.study);
  std::vector<const OutcomeShare*> motions;
  for (const OutcomeShare& a : r.attractors)
    if (a.share.count > 0 || a.id == balanced_id) motions.push_back(&a);
  if (brief)
    std::stable_sort(motions.begin(), motions.end(), [](const OutcomeShare* a, const OutcomeShare* b) {
      return b->id != balanced_id && (a->id == balanced_id || a->share.share > b->share.share);
    });
  const bool velocities = t && (full || motions.size() > 1);
  const std::size_t left_out = brief && motions.size() > most ? motions.size() - most : 0;
  motions.resize(motions.size() - left_out);
  // The table with all columns is wide.
  DocumentTable table{{"outcome", brief ? "probability (95 % interval)" : "share (95 % interval)"}};
  const auto column = [&](bool there, const std::string& title, bool spare) {
    if (!there) return;
    if (spare) table.spare.push_back(table.header.size());
    table.header.push_back(title);
  };
  column(open, "bounds", false);
  column(velocities, fmt::format("RMS at end, {}", velocity.name), false);
  const auto number_unit = [&](const OutcomeNumber& n) {
    return n.dimension ? unit_of(r.study, *n.dimension) : study::ShownUnit{"", 1.0};
  };
  for (const OutcomeNumber& n : outcome_numbers)
    column(full, physical && n.dimension ? fmt::format("{}, {}", n.title, number_unit(n).name) : n.title, true);
  column(full, "starts", true);
  column(full && even, "as good as", true);
  column(graded, "balance quality", true);
  column(full && t, fmt::format("displacement, {}", length.name), true);
  const auto row = [&](const std::string& name, Tone tone, const OutcomeShare& o, bool ended) {
    std::vector<DocumentCell> cells{{name, tone, false, true}, number_cell(share_with_interval(o.share))};
    if (open) cells.push_back(number_cell(o.id == undecided_code ? "-" : bounds_text(o.share)));
    const TransientGroup* group = t ? t->of(o.id) : nullptr;
    const auto mean = [&](float TransientRow::*value, const study::ShownUnit& unit) {
      return number_cell(group ? fmt::format("{:.3g}", group->figure(value).mean * unit.size) : "-");
    };
    if (velocities) cells.push_back(mean(&TransientRow::rms_velocity, velocity));
    for (const OutcomeNumber& n : outcome_numbers)
      if (full) cells.push_back(number_cell(ended ? fmt::format("{:.4g}", n.value(o) * number_unit(n).size) : "-"));
    if (full) cells.push_back(number_cell(fmt::format("{}", o.share.count)));
    if (full && even) cells.push_back(number_cell(as_good_as(o.share)));
    const auto grade = group && graded ? left_grade(*group, r.study) : std::nullopt;
    if (graded) cells.push_back(number_cell(grade ? grade_text(*grade) : "-"));
    if (full && t) cells.push_back(mean(&TransientRow::peak_radial_at_end, length));
    table.rows.push_back(std::move(cells));
  };
  for (const OutcomeShare* a : motions) row(reader_title(*a, physical), Tone::plain, *a, a->share.count > 0);
  for (const OutcomeShare& o : r.others())
    if (o.share.count > 0) row(end_name(r, o), Tone::open, o, false);
  std::vector<std::string> captions;
  if (open)
    captions.emplace_back(
        "Intervals hold only if the undecided runs end elsewhere; bounds are 95 % limits that hold however they "
        "end.");
  if (left_out > 0) captions.push_back(fmt::format("--details lists {} more outcomes.", left_out));
  if (t && full) captions.emplace_back("Velocity and displacement at the end: means over the runs of the outcome.");
  if (graded)
    captions.push_back(fmt::format(
        "Balance quality: ISO 21940-11's grade of the unbalance that is left{}, for comparison only.",
        r.study.parameters.tilts() ? " in the plane of the outermost bearing that has more of it for its share" : ""));
  if (full)
    captions.push_back(fmt::format(
        "Known after: mean time until the outcome is certain, from when the drive no longer changes and the "
        "balls are free{}.",
        physical ? "" : ", in 1/omega_c"));
  table.caption = fmt::format("{}", fmt::join(captions, " "));
  return table;
}

void add_sensitivity(Document& document, const SensitivityResult& r) {
  if (r.inputs.empty()) {
    document.add(Paragraph{r.rows == 0 ? "What balance depends on: nothing was followed to the end."
                                       : fmt::format("What balance depends on: nothing; of {} starts {} balanced.",
                                                     2 * r.rows, r.balanced.count == 0 ? "none" : "all")});
  } else {
    DocumentTable table{{"balance depends on", "first order", "95 % interval", "total", "95 % interval"}};
    for (const auto& [key, indices] : r.inputs)
      table.rows.push_back(row_of(
          "tntnt", {key == start_input ? "where the start begins" : key, fmt::format("{:.2f}", indices.first.value),
                    range_text(indices.first), fmt::format("{:.2f}", indices.total.value), range_text(indices.total)}));
    table.caption =
        "First order: the part of the variance of \"ends balanced\" that goes away on average if this alone is known; "
        "total: the part that is left if all else is.";
    document.add(std::move(table));
  }
  document.add(Paragraph{
      fmt::format("{} starts in {} rows, {} of the independent starts balanced ({}){}.{}", r.evaluations, r.rows,
                  percent(r.balanced.share, digits_for(r.balanced)), interval(r.balanced),
                  r.undecided > 0 ? fmt::format("; {} undecided ones count as not balanced", r.undecided) : "",
                  r.partial ? " PARTIAL: stopped before all rows were done." : "")});
}

}  // namespace equipoise
