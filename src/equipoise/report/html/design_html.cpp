// Words, tables and drawings for a design.
#include "equipoise/report/html/design_html.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/plural.hpp"
#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/answers/quantities.hpp"
#include "equipoise/report/answers/design_words.hpp"
#include "equipoise/report/reports/result_tables.hpp"

namespace equipoise {

namespace {

class DesignDocument {
 public:
  DesignDocument(const DesignResult& result, const GivenMachine& machine) : r_(result), machine_(machine) {}

  Document make() {
    const DesignVerdict verdict = design_verdict(r_);
    document_ = page_with(r_.study, verdict.words + " " + verdict.because);
    add(Paragraph{"How far each may be off: " + verdict.margins});
    if (r_.partial)
      add(Paragraph{
          fmt::format("Stopped early: what the search had found by then, judged on {}.",
                      r_.chosen && r_.front[*r_.chosen].held_out ? "starts that it did not see" : "its own starts"),
          Tone::open});
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

  void add_drawings(const std::vector<Plot>& plots, const std::string& caption, bool wide) {
    if (!plots.empty()) add(drawn(plots, design_title(r_), caption, wide));
  }

  void chosen() {
    const DesignCandidate& best = r_.front[*r_.chosen];
    add(Heading{2, "The chosen design", ""});
    DocumentTable values{{"chosen", "value", "could be"}};
    for (std::size_t k = 0; k < best.settings.size(); ++k)
      values.rows.push_back({{key_words(best.settings[k].key), Tone::plain, false, true},
                             value_cell(best.settings[k].value),
                             {range_words(r_.variables[k])}});
    add(std::move(values));
    add_drawings(spin_up_plots(r_), "The spin-up: piecewise linear, then constant.", true);
    add(figure_table(r_));
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
    if (!v.numbers.empty())
      return fmt::format("{} values from {} to {}", v.choices.size(), setting_text(v.choices.front()),
                         setting_text(v.choices.back()));
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
                       plural(v.spin_up->points), v.low, v.high, unit, v.spin_up->until,
                       v.spin_up->time_unit.empty() ? "" : " ", v.spin_up->time_unit, slope);
  }

  void front() {
    if (r_.objectives.size() < 2) return;
    add(Heading{2, "Trade-offs", ""});
    add_drawings(front_plots(r_),
                 "Candidates that no other beats in every objective; bars are 95 % intervals of the vertical axis.",
                 true);
    add(front_table(r_, key_words));
  }

  void margins() {
    if (r_.margins.empty()) return;
    add(Heading{2, "How far each may be off", ""});
    add(margin_table(r_, key_words));
    add_drawings(margin_plots(r_, 4), "What becomes of it as one number moves and all others stay.", false);
  }

  void origin() {
    add(Heading{2, "How it was found", ""});
    if (std::any_of(r_.history.begin(), r_.history.end(),
                    [&](const DesignStep& step) { return step.value != r_.history.front().value; }))
      add_drawings(history_plots(r_), "The best that was known after so many trajectories.", true);
    std::string text = fmt::format(
        "{} candidates by {}, all on the same starts {}; {} trajectories of {}. The front was judged on other starts, "
        "seed {}. ",
        r_.candidates, design_method_names[static_cast<std::size_t>(r_.method)],
        starts_words(r_.study, drawn_keys(r_.study)), r_.trajectories, r_.budget, r_.held_out_seed);
    text += model_words(r_.study, {r_.cpu_target, r_.threads, r_.seconds, r_.cpu_seconds});
    if (r_.resumed > 0) text += fmt::format("; {} ensembles from an earlier run's file", r_.resumed);
    add(Paragraph{text + "."});
    if (!r_.proposed.empty())
      add(Listing{"The study states no [design]; this one was proposed and taken", r_.proposed});
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
