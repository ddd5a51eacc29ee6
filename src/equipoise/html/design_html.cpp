// Words, tables and drawings for a design.
#include "equipoise/html/design_html.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/drawing/chart_svg.hpp"
#include "equipoise/drawing/document.hpp"
#include "equipoise/html/answer.hpp"
#include "equipoise/html/page_parts.hpp"
#include "equipoise/plots/design_charts.hpp"
#include "equipoise/plots/quantities.hpp"
#include "equipoise/reports/design_report.hpp"

namespace equipoise {

namespace {

class DesignDocument {
 public:
  DesignDocument(const DesignResult& result, const GivenMachine& machine) : r_(result), machine_(machine) {}

  Document make() {
    document_ = page_with(r_.study, design_answer(r_));
    if (r_.partial)
      add(Paragraph{"Stopped early: what the search had found by then, judged on its own starts.", Tone::open});
    if (r_.chosen) {
      chosen();
      front();
      margins();
    }
    add_machine(document_, machine_, "in the study, before anything is chosen");
    origin();
    return std::move(document_);
  }

 private:
  void add(Block block) { document_.blocks.push_back(std::move(block)); }

  void add_drawings(const std::vector<Chart>& charts, const std::string& caption, bool wide) {
    if (charts.empty()) return;
    DrawingRow row;
    row.wide = wide && charts.size() == 1;
    row.large = !row.wide;
    for (const Chart& chart : charts) row.drawings.push_back({chart.title, chart_svg(chart, design_title(r_)), "", ""});
    row.caption = caption;
    add(std::move(row));
  }

  void chosen() {
    const DesignCandidate& best = r_.front[*r_.chosen];
    add(Heading{2, "The chosen design", ""});
    DocumentTable values{{"chosen", "value", "could be"}, {}, "", false, {}};
    for (std::size_t k = 0; k < best.settings.size(); ++k)
      values.rows.push_back({{key_words(best.settings[k].key), Tone::plain, false, true},
                             value_cell(best.settings[k].value),
                             {range_words(r_.variables[k])}});
    add(std::move(values));
    add_drawings(spin_up_charts(r_), "The spin-up: piecewise linear, then constant.", true);
    figures(best);
    if (!r_.limited_by.empty()) {
      std::string words;
      for (const std::string& w : r_.limited_by) words += (words.empty() ? "" : "; ") + w;
      add(Paragraph{"What limits it: " + words + "."});
    }
  }

  // A spin-up is a sentence, which a narrow screen may wrap.
  static DocumentCell value_cell(const StudyValue& value) {
    return value.table() ? DocumentCell{setting_text(value)} : number_cell(setting_text(value));
  }

  static std::string range_words(const DesignVariable& v) {
    if (!v.choices.empty()) {
      std::string words;
      for (const StudyValue& choice : v.choices) words += (words.empty() ? "" : ", ") + setting_text(choice);
      return words;
    }
    const std::string unit = v.unit.empty() ? "" : " " + v.unit;
    if (!v.spin_up) return fmt::format("{:.4g} to {:.4g}{}", v.low, v.high, unit);
    const std::string slope = v.spin_up->slope
                                  ? fmt::format(", at most {:.4g}{} a {}", *v.spin_up->slope, unit,
                                                v.spin_up->time_unit.empty() ? "unit of time" : v.spin_up->time_unit)
                                  : "";
    return fmt::format("{} point{} from {:.4g} to {:.4g}{} within {:.4g}{}{}{}", v.spin_up->points,
                       v.spin_up->points == 1 ? "" : "s", v.low, v.high, unit, v.spin_up->until,
                       v.spin_up->time_unit.empty() ? "" : " ", v.spin_up->time_unit, slope);
  }

  void figures(const DesignCandidate& best) {
    const DesignSample& now = best.best_known();
    if (now.figures.empty()) return;
    DocumentTable table{{"figure", "as it is", "chosen", "must be"}, {}, "", false, {}};
    for (std::size_t k = 0; k < r_.figures.size(); ++k) {
      const DesignFigure& f = r_.figures[k];
      std::string must;
      Tone tone = Tone::plain;
      for (const DesignLimit& limit : r_.limits)
        if (limit.figure == k) {
          must = limit_text(f, limit);
          const DesignEstimate& e = now.figures[k];
          const bool kept = !(limit.below && !(e.high < *limit.below)) && !(limit.above && !(e.low > *limit.above));
          tone = kept ? Tone::good : Tone::bad;
        }
      DocumentCell after = number_cell(estimate_with_interval(f, now.figures[k]));
      after.tone = tone;
      const bool had = r_.before && !r_.before->figures.empty();
      table.rows.push_back({{f.name, Tone::plain, false, true},
                            number_cell(had ? estimate_with_interval(f, r_.before->figures[k]) : "-"),
                            after,
                            {must}});
    }
    const DesignFigure undecided{"undecided", "", false, true};
    table.rows.push_back({{"undecided", Tone::plain, false, true},
                          number_cell(r_.before ? estimate_with_interval(undecided, r_.before->undecided) : "-"),
                          number_cell(estimate_with_interval(undecided, now.undecided)),
                          {""}});
    const std::string optimism = optimism_text(r_);
    table.caption =
        fmt::format("With 95 % intervals, over {} starts{}{}.", now.starts,
                    best.held_out ? " that the search did not see" : "", optimism.empty() ? "" : "; " + optimism);
    add(std::move(table));
  }

  void front() {
    if (r_.objectives.size() < 2) return;
    add(Heading{2, "What can be had for what", ""});
    add_drawings(front_charts(r_),
                 "Candidates that no other beats in every objective; bars are 95 % intervals of what stands upright.",
                 true);
    DocumentTable table;
    for (const std::size_t k : r_.objectives) table.header.push_back(r_.figures[k].name);
    for (const DesignVariable& v : r_.variables) table.header.push_back(key_words(v.key));
    for (std::size_t m = 0; m < r_.front.size(); ++m) {
      const DesignSample& s = r_.front[m].best_known();
      std::vector<DocumentCell> row;
      for (const std::size_t k : r_.objectives)
        row.push_back(number_cell(s.figures.empty() ? "-" : estimate_with_interval(r_.figures[k], s.figures[k])));
      for (const DesignSetting& setting : r_.front[m].settings) row.push_back(number_cell(setting_text(setting.value)));
      if (r_.chosen == m)
        for (DocumentCell& cell : row) cell.tone = Tone::good;
      table.rows.push_back(std::move(row));
    }
    table.caption =
        "The chosen one is marked: the nearest to what would be best in every objective, each measured by the front's "
        "own range.";
    add(std::move(table));
  }

  void margins() {
    if (r_.margins.empty()) return;
    add(Heading{2, "How far each may be off", ""});
    const DesignFigure& first = r_.figures[r_.objectives.front()];
    DocumentTable table{
        {"varied alone", "chosen", "may go from", "to", "near it", "what fails beyond"}, {}, "", false, {}};
    for (const DesignMargin& m : r_.margins) {
      const std::string unit = m.unit.empty() ? "" : " " + m.unit;
      const bool ordered = has_order(m);  // choices have no order
      table.rows.push_back({{key_words(margin_name(m.key)), Tone::plain, false, true},
                            number_cell(fmt::format("{:.4g}{}", m.value, unit)),
                            number_cell(ordered ? fmt::format("{:.4g}", m.keeps_from) : "-"),
                            number_cell(ordered ? fmt::format("{:.4g}", m.keeps_to) : "-"),
                            number_cell(estimate_text(first, m.effect)),
                            {ordered ? fails_text(m) : "other choices: see the drawing"}});
    }
    table.caption = fmt::format(
        "{} Near it: by how much {} changes at most within a tenth of the range; what matters most comes first.",
        r_.limits.empty() ? "Until the first objective is surely worse." : "Until a requirement fails.", first.name);
    add(std::move(table));
    add_drawings(margin_charts(r_, 4), "What becomes of it as one number moves and all others stay.", false);
  }

  void origin() {
    add(Heading{2, "How it was found", ""});
    if (std::any_of(r_.history.begin(), r_.history.end(),
                    [&](const DesignStep& step) { return step.value != r_.history.front().value; }))
      add_drawings(history_charts(r_), "The best that was known after so many trajectories.", true);
    std::string text = fmt::format(
        "{} candidates by {}, all on the same starts {}; {} trajectories of {}. The front was judged on other starts, "
        "seed {}. ",
        r_.candidates, design_method_names[static_cast<std::size_t>(r_.method)],
        starts_words(r_.study, drawn_keys(r_.study)), r_.trajectories, r_.budget, r_.held_out_seed);
    text += model_words(r_.study, {r_.cpu_target, r_.threads, r_.seconds, r_.cpu_seconds});
    if (r_.resumed > 0) text += fmt::format("; {} ensembles from an earlier run's file", r_.resumed);
    add(Paragraph{text + "."});
    if (!r_.best_study.empty()) add(Listing{"The chosen design as a study", r_.best_study});
    add_study(document_, r_.study);
  }

  const DesignResult& r_;
  const GivenMachine& machine_;
  Document document_;
};

}  // namespace

std::string design_html(const DesignResult& result, const GivenMachine& machine) {
  return document_html(DesignDocument(result, machine).make());
}

}  // namespace equipoise
