// Of an ensemble only what answers the question. Every number is one that its JSON has.
#include "equipoise/report/reports/basin_summary.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/plural.hpp"
#include "equipoise/machine/mechanics/forced_vibration.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/answers/quantities.hpp"
#include "equipoise/report/answers/sampling_text.hpp"
#include "equipoise/report/answers/start_text.hpp"
#include "equipoise/report/decision/plain_names.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/reports/sensitivity_report.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/results/commands/left_grade.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

namespace {
using study::Dimension;

// The figures that matter most, each with its limit if there is one, without balls, and with them in the median and in
// nine runs of ten.
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
    cells.push_back({name, Tone::plain, false, true});
    for (const std::string& text : figures) cells.push_back(number_cell(text));
    if (limited) cells.push_back({over ? "OVER" : "", Tone::bad});
    cells.resize(header.size());
  };
  const auto figure_row = [&](float TransientRow::*figure, bool end, const std::string& name) {
    const std::size_t k = figure_place(figure);
    const TransientFigure& f = transient_figures[k];
    if (!r.transients->asks(f, limits) || with.figures[k].count == 0) return;
    const study::ShownUnit unit = study::shown_unit(f.told_in(), study.scales);
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
    const double mm_per_s = study::shown_unit(Dimension::velocity, study.scales).size;
    const auto most = limits.grade ? std::optional(*limits.grade * mm_per_s) : std::nullopt;
    const auto shown = [](const std::optional<double>& g) { return g ? fmt::format("G {:.3g}", *g) : "-"; };
    std::vector<std::string> figures{shown(without), shown(grade)};
    if (limited) figures.insert(figures.begin(), shown(most));
    row("  balance quality, mean", figures, most && *grade > *most);
  }
  figure_row(&TransientRow::settling_time, true, "settled after");
  return table;
}

class Summary {
 public:
  explicit Summary(const BasinResult& r) : r_(r), study_(r.study), shown_(r.study) {
    if (r.transients) all_ = r.transients->of(std::nullopt);
  }

  Document make(std::span<const TriedChange> tried) {
    document_.sheet = true;
    if (const auto verdict = verdict_of(r_, tried))
      document_.add(verdict_notice(*verdict));
    else
      document_.add(Paragraph{answer_sentence(r_), Tone::plain, true});
    add_stopped(document_, r_);
    add_note(document_, r_);
    add_hanging(document_, study_);
    if (study_.parameters.balls == 0 && r_.without_balls) {
      document_.add(bare_table(r_));
      for (const std::string& sentence : without_balls_words(r_)) document_.add(Paragraph{sentence});
    } else if (r_.starts > 0) {
      // Vibration is what counts in a machine, and probabilities in a rotor without units.
      std::vector<DocumentTable> tables{outcome_table(r_, true)};
      if (all_) tables.insert(study_.scales ? tables.begin() : tables.end(), short_table(r_));
      for (DocumentTable& table : tables) document_.add(std::move(table));
      if (r_.sensitivity) add_sensitivity(document_, *r_.sensitivity);
      if (tells_without_balls(r_))
        for (const std::string& sentence : not_steady_words(r_.without_balls->bare, "Without balls", study_))
          document_.add(Paragraph{sentence});
    }
    in_short();
    return std::move(document_);
  }

 private:
  // What the numbers are of.
  void in_short() {
    const model::Parameters& p = study_.parameters;
    const auto shown = [&](double value, Dimension d) { return shown_.text(value, d); };
    std::string words = study_.scales
                            ? fmt::format("Machine: {}", shown(1.0, Dimension::mass))
                            : fmt::format("Rotor: eccentricity {:.4g}, damping {:.4g}", p.eccentricity, p.damping[0]);
    if (!p.tilts() && study_.scales) {
      const auto critical = model::critical_speeds(p);
      words += fmt::format(", critical speed {}", shown(critical[0], Dimension::speed));
      if (critical[0] != critical[1]) words += fmt::format(" and {} (x, y)", shown(critical[1], Dimension::speed));
    }
    if (!study_.speed.driven())
      words += fmt::format(", run at {}", shown(study_.speed_profile().final_speed(), Dimension::speed));
    words += fmt::format("; {} ball{}", p.balls, plural(p.balls));
    if (p.balls > 0 && study_.scales) words += fmt::format(" on a circle of {}", shown(1.0, Dimension::length));
    if (study_.speed.law == model::SpeedLaw::published && study_.speed.profile != Profile::constant)
      words += "; PUBLISHED speed law, psi = t Omega(t)";
    words += ".";
    if (const std::string held = release_text(study_); p.balls > 0 && !held.empty())
      words += fmt::format(" {}.", capitalised(held));
    if (all_)
      words +=
          tells_without_balls(r_) ? " \"No balls\" and \"with balls\" are medians." : " \"With balls\" is the median.";
    if (all_ && !study_.scales) words += " Units: R, R omega_c, M R omega_c^2, 1/omega_c.";
    if (all_ && study_.parameters.gravity != 0.0)
      words += " Displacements are from where the rotor rests; forces include its weight.";
    if (all_ && study_.parameters.tilts()) words += " Where along the shaft figures are taken: --details.";
    if (r_.starts > 0) {
      const std::vector<std::string> drawn = drawn_keys(study_);
      const bool plain = study_.sampling.method.value_or(SamplingMethod::random) == SamplingMethod::random &&
                         drawn.empty() && study_.sampling.box.empty() && drawn_instead(study_).empty();
      words += fmt::format(" {} runs{},", r_.starts,
                           r_.own_starts ? " from given starts"
                           : plain       ? fmt::format(", seed {}", study_.sampling.seed)
                                         : " " + starts_words(study_, drawn));
    }
    document_.add(Paragraph{fmt::format("{} {:.2g} s CPU time. More: --details, --json.", words, r_.cpu_seconds)});
  }

  const BasinResult& r_;
  const Study& study_;
  const PageQuantities shown_;
  const TransientGroup* all_ = nullptr;
  Document document_;
};

}  // namespace

DocumentTable outcome_table(const BasinResult& r, bool brief) {
  constexpr std::size_t most = 6;
  const bool even = r.study.sampling.method.value_or(SamplingMethod::random) != SamplingMethod::random;
  const bool open = r.undecided.count > 0, physical = r.study.scales.has_value();
  const TransientResult* t = r.transients ? &*r.transients : nullptr;
  const study::ShownUnit velocity = study::shown_unit(Dimension::velocity, r.study.scales);
  const study::ShownUnit length = study::shown_unit(Dimension::length, r.study.scales);
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
  const auto unit_of = [&](const OutcomeNumber& n) {
    return n.dimension ? study::shown_unit(*n.dimension, r.study.scales) : study::ShownUnit{"", 1.0};
  };
  for (const OutcomeNumber& n : outcome_numbers)
    column(full, physical && n.dimension ? fmt::format("{}, {}", n.title, unit_of(n).name) : n.title, true);
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
      if (full) cells.push_back(number_cell(ended ? fmt::format("{:.4g}", n.value(o) * unit_of(n).size) : "-"));
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

std::string end_name(const BasinResult& r, const OutcomeShare& o) {
  return o.id == stalled_code
             ? "stalled below " + engineering(r.study.scales, r.study.stall_speed(), study::Dimension::speed)
             : o.name;
}

void add_stopped(Document& document, const BasinResult& r) {
  if (r.study.parameters.balls == 0 ? r.without_balls.has_value() : !r.partial && r.starts > 0) return;
  std::string text = "PARTIAL: stopped before anything was known.";
  if (r.study.parameters.balls > 0)
    text = r.starts == 0 ? "PARTIAL: stopped before the first start was decided; there are no shares."
                         : fmt::format("PARTIAL: stopped after {}{} starts; all figures are of those.", r.starts,
                                       r.asked > 0 ? fmt::format(" of {}", r.asked) : "");
  document.add(Paragraph{text, Tone::bad});
}

void add_note(Document& document, const BasinResult& r) {
  if (r.study.parameters.balls > 0 && !r.note.empty())
    document.add(Paragraph{fmt::format("Note: {}.", note_text(r.study, r.note)), Tone::open});
}

void add_hanging(Document& document, const Study& study) {
  if (const std::string hanging = hanging_text(study); !hanging.empty())
    document.add(Paragraph{fmt::format("Warning: {}.", hanging), Tone::open});
}

Document basin_summary(const BasinResult& result, std::span<const TriedChange> tried) {
  return Summary(result).make(tried);
}

}  // namespace equipoise
