// Fronts, choices and margins in words and numbers.
#include "equipoise/report/reports/reports.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/answers/design_words.hpp"
#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/csv.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

std::string estimate_or_dash(const DesignResult& r, const DesignSample* s, std::size_t k) {
  return s && !s->figures.empty() ? estimate_with_interval(r.figures[k], s->figures[k]) : "-";
}

// What fails where a margin ends; what was tried, if nothing does.
std::string fails_text(const DesignMargin& m) {
  std::string text;
  if (!m.fails_below.empty()) text = "below: " + m.fails_below;
  if (!m.fails_above.empty()) text += (text.empty() ? "above: " : "; above: ") + m.fails_above;
  return text.empty() ? "nothing that was tried" : text;
}

// By how much the search thought the chosen design better than the held-out starts say; empty if no different.
std::string optimism_text(const DesignResult& r) {
  const DesignCandidate& best = r.front[*r.chosen];
  const std::size_t k = r.objectives.front();
  if (!best.held_out || best.search.figures.empty() || best.held_out->figures.empty()) return "";
  const double search = best.search.figures[k].value, held_out = best.held_out->figures[k].value;
  const double gain = r.figures[k].up ? search - held_out : held_out - search;
  const std::string found = estimate_text(r.figures[k], search);
  if (!std::isfinite(gain) || found == estimate_text(r.figures[k], held_out)) return "";
  return fmt::format("; on the {} starts of the search it was {} ({}), {}", best.search.starts, found,
                     figure_words(r.figures[k], true), gain > 0.0 ? "which was optimistic" : "which was pessimistic");
}

// Candidates that no other beats, the chosen one good.
DocumentTable front_table(const DesignResult& r) {
  DocumentTable table;
  for (const std::size_t k : r.objectives) table.header.push_back(figure_words(r.figures[k], true));
  for (const DesignVariable& v : r.variables) table.header.push_back(thing_of(v.key));
  for (std::size_t m = 0; m < r.front.size(); ++m) {
    std::vector<DocumentCell> row;
    for (const std::size_t k : r.objectives)
      row.push_back(number_cell(estimate_or_dash(r, &r.front[m].best_known(), k)));
    for (const DesignSetting& setting : r.front[m].settings) row.push_back(number_cell(setting_text(setting.value)));
    for (DocumentCell& cell : row) cell.tone = r.chosen == m ? Tone::good : Tone::plain;
    table.rows.push_back(std::move(row));
  }
  table.caption = fmt::format(
      "{} candidate{} that no other beats. The chosen one is marked: it lies nearest to the best of every objective, "
      "each scaled by the front's own range.",
      r.front.size(), plural(r.front.size()));
  return table;
}

// The chosen design next to the study as it is.
DocumentTable figure_table(const DesignResult& r) {
  const DesignCandidate& best = r.front[*r.chosen];
  const DesignSample& now = best.best_known();
  DocumentTable table{{"figure", design_as_given, "chosen", "must be"}, {}, "", false, {3}, 1};
  const DesignSample* before = r.before ? &*r.before : nullptr;
  for (std::size_t k = 0; k < now.figures.size(); ++k) {
    table.rows.push_back(row_of(
        "lnnt", {figure_words(r.figures[k], true), estimate_or_dash(r, before, k), estimate_or_dash(r, &now, k), ""}));
    for (const DesignLimit& limit : r.limits)
      if (limit.figure == k) {
        table.rows.back()[2].tone = surely_keeps(limit, now.figures[k]) ? Tone::good : Tone::bad;
        table.rows.back()[3].text = limit_text(r.figures[k], limit);
      }
  }
  const DesignFigure undecided{"undecided", "", false, true};
  table.rows.push_back(
      row_of("lnnt", {figure_words(undecided), before ? estimate_with_interval(undecided, before->undecided) : "-",
                      estimate_with_interval(undecided, now.undecided), ""}));
  table.caption = fmt::format("With 95 % intervals, over {} starts{}, seed {}{}.", now.starts,
                              best.held_out ? " that the search did not see" : " of the search",
                              best.held_out ? r.held_out_seed : r.search_seed, optimism_text(r));
  return table;
}

// How much each value of the chosen design may vary.
DocumentTable margin_table(const DesignResult& r) {
  const DesignFigure& first = r.figures[r.objectives.front()];
  DocumentTable table{{"varied alone", "chosen", "may go from", "to", "near it", "what fails beyond"}};
  for (const DesignMargin& m : r.margins) {
    const bool ordered = has_ends(m);
    table.rows.push_back(row_of(
        "lnnnnt", {thing_of(m.key), fmt::format("{}{:.4g}{}{}", m.prefix, m.value, m.unit.empty() ? "" : " ", m.unit),
                   ordered ? fmt::format("{}{:.4g}", m.prefix, m.keeps_from) : "-",
                   ordered ? fmt::format("{}{:.4g}", m.prefix, m.keeps_to) : "-", estimate_text(first, m.effect),
                   ordered ? fails_text(m) : "choices have no ends"}));
  }
  table.caption = fmt::format(
      "{} Near it: by how much {} changes at most within a tenth of the range; what matters most comes first.",
      r.limits.empty() ? "Until the first objective is shown to be worse." : "Until a requirement fails.",
      figure_words(first));
  return table;
}

// A spin-up is a sentence, which a narrow screen may wrap.
DocumentCell value_cell(const StudyValue& value) {
  return value.table() ? DocumentCell{setting_text(value)} : number_cell(setting_text(value));
}

std::string range_words(const DesignVariable& v) {
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

DocumentTable chosen_table(const DesignResult& r) {
  const DesignCandidate& best = r.front[*r.chosen];
  DocumentTable table{{"chosen", "value", "could be"}};
  for (std::size_t k = 0; k < best.settings.size(); ++k)
    table.rows.push_back({label_cell(thing_of(best.settings[k].key)),
                          value_cell(best.settings[k].value),
                          {range_words(r.variables[k])}});
  return table;
}

std::string stopped_design_text(const DesignResult& r) {
  const bool checked = r.chosen && r.front[*r.chosen].held_out;
  std::string text = fmt::format("PARTIAL: stopped; what the search had found by then, judged on {}. ",
                                 checked ? "starts that it did not see" : "its own starts");
  if (r.trajectories >= r.budget) return text + "Some of its checks were still to be made.";
  return text + fmt::format("{} of {} trajectories were left, for more candidates and for checks of the best.",
                            r.budget - r.trajectories, r.budget);
}

void add_drawings(Document& document, const DesignResult& r, const std::vector<Plot>& plots, const std::string& caption,
                  bool wide = true) {
  if (plots.empty()) return;
  DrawingRow row = drawn(plots, caption, wide);
  row.details = design_title(r);
  document.add(std::move(row));
}

void add_chosen(Document& document, const DesignResult& r) {
  document.add(Heading{2, "The chosen design", ""});
  document.add(chosen_table(r));
  add_drawings(document, r, spin_up_plots(r), "The spin-up: piecewise linear, then constant.");
  document.add(figure_table(r));
  if (!r.limited_by.empty()) document.add(Paragraph{fmt::format("What limits it: {}.", fmt::join(r.limited_by, "; "))});
  if (r.objectives.size() > 1) {
    document.add(Heading{2, "Trade-offs", ""});
    add_drawings(document, r, front_plots(r),
                 "Candidates that no other beats in every objective; bars are 95 % intervals of the vertical axis.");
    document.add(front_table(r));
  }
  if (!r.margins.empty()) {
    document.add(Heading{2, "How far each may vary", ""});
    document.add(margin_table(r));
    add_drawings(document, r, margin_plots(r, 4), "What becomes of it as one number moves and all others stay.", false);
  }
}

}  // namespace

Document document_of(const DesignResult& r) {
  const DesignVerdict verdict = design_verdict(r);
  const Tone tone = r.partial ? Tone::open : r.feasible ? Tone::good : Tone::bad;
  Document document =
      document_with(r.study, "", uncertain_text(r.study),
                    Notice{verdict.words, tone, {{"why", verdict.because}, {"margins", verdict.margins}}});
  if (!r.proposed.empty()) document.add(Listing{"The study states no [design]; proposed [design]", r.proposed, true});
  if (r.partial) document.add(Paragraph{stopped_design_text(r), Tone::open});
  if (r.chosen) add_chosen(document, r);
  if (std::any_of(r.history.begin(), r.history.end(),
                  [&](const DesignStep& step) { return step.value != r.history.front().value; }))
    add_drawings(document, r, history_plots(r), "The best design known after each number of trajectories.");
  if (!r.best_study.empty()) document.add(Listing{"The chosen design as a study", r.best_study});
  std::string words =
      fmt::format("{} candidate{} by {}, all on the same starts {}; {} trajectories of {}.", r.candidates,
                  plural(r.candidates), design_method_names[static_cast<std::size_t>(r.method)],
                  starts_words(r.study, drawn_keys(r.study)), r.trajectories, r.budget);
  if (r.chosen) words += fmt::format(" The front was judged on other starts, seed {}.", r.held_out_seed);
  if (r.resumed > 0) words += fmt::format(" {} ensembles from an earlier run.", r.resumed);
  add_origin(document, r.study, words, computed_text(r));
  return document;
}

// What has no end is written as null.
void to_json(Json& json, const PartOf<DesignCandidate, DesignResult>& of) {
  const auto& [c, r] = of;
  const DesignSample& sample = c.best_known();
  Json variables = Json::object(), objectives = Json::object(), constraints = Json::object();
  for (const DesignSetting& s : c.settings) variables[s.key] = s.value;
  if (!sample.figures.empty()) {
    for (const std::size_t k : r.objectives) {
      Json& objective = objectives[r.figures[k].name] = sample.figures[k];
      if (c.held_out && !c.search.figures.empty()) put(objective, "on_search_starts", c.search.figures[k].value);
    }
    for (const DesignLimit& limit : r.limits) {
      const DesignEstimate& e = sample.figures[limit.figure];
      Json& one = constraints[r.figures[limit.figure].name] = e;
      put_known(one, "below", limit.below, "above", limit.above);
      put(one, "kept", keeps(limit, e.value), "surely", surely_keeps(limit, e));
    }
  }
  json = object("as_it_is", c.as_it_is, "things", things_chosen(r.study, c.settings), "variables", variables,
                "objectives", objectives, "constraints", constraints, "undecided", sample.undecided, "starts",
                sample.starts, "held_out", c.held_out.has_value());
}

void to_json(Json& json, const PartOf<DesignPoint, DesignResult>& of) {
  const auto& [p, r] = of;
  Json figures = Json::object();
  for (std::size_t k = 0; k < p.sample.figures.size(); ++k) figures[r.figures[k].name] = p.sample.figures[k];
  json = object("value", p.given, "figures", figures, "starts", p.sample.starts);
}

void to_json(Json& json, const PartOf<DesignMargin, DesignResult>& of) {
  const DesignMargin& m = of.part;
  json = object("unit", m.unit, "value", m.value, "keeps_from", m.keeps_from, "keeps_to", m.keeps_to, "fails_below",
                m.fails_below, "fails_above", m.fails_above, "effect", m.effect, "points", PartOf{m.points, of.whole});
}

void to_json(Json& json, const DesignStep& s) {
  json = object("trajectories", s.trajectories, "violation", s.violation, "value", s.value);
}

std::string json_text(const DesignResult& r) {
  const DesignVerdict verdict = design_verdict(r);
  Json json =
      object("verdict", object("words", verdict.words, "because", verdict.because, "margins", verdict.margins), "front",
             PartOf{r.front, r}, "chosen", r.chosen ? Json(PartOf{r.front[*r.chosen], r}) : Json(), "before", nullptr);
  if (r.before && !r.before->figures.empty()) {
    DesignCandidate as_it_is;
    as_it_is.search = *r.before;
    as_it_is.as_it_is = true;
    json["before"] = PartOf{as_it_is, r};
    json["before"]["held_out"] = r.chosen && r.front[*r.chosen].held_out.has_value();
  }
  Json units = Json::object(), margins = Json::object();
  for (const DesignFigure& f : r.figures) units[f.name] = f.unit;
  for (const DesignMargin& m : r.margins) margins[m.key] = PartOf{m, r};
  put(json, "feasible", r.feasible, "leave_out", r.leave_out, "trajectories", r.trajectories, "budget", r.budget,
      "candidates", r.candidates, "method", design_method_names[static_cast<std::size_t>(r.method)], "units", units,
      "margins", margins, "limited_by", r.limited_by, "history", r.history, "partial", r.partial, "confidence", 0.95,
      "search_seed", r.search_seed, "held_out_seed", r.held_out_seed, "resumed", r.resumed, "best_study", r.best_study,
      "proposed_design", r.proposed.empty() ? Json() : Json(r.proposed));
  add_computed(json, r);
  return json.dump(2) + "\n";
}

std::string design_csv(const DesignResult& r) {
  std::string text =
      fmt::format("# equipoise {}: candidates that no other beats{}\n", version_string, r.partial ? ", PARTIAL" : "") +
      csv_study(r.study);
  std::string titles;
  for (const DesignVariable& v : r.variables) titles += csv_text(v.key) + ",";
  for (const DesignFigure& f : r.figures) {
    const std::string name = f.unit.empty() ? f.name : fmt::format("{} ({})", f.name, f.unit);
    titles += fmt::format("{0},{1}_low,{1}_high,", csv_text(name), f.name);
  }
  text += titles + "undecided,starts,held_out,chosen\n";
  for (std::size_t m = 0; m < r.front.size(); ++m) {
    const DesignSample& sample = r.front[m].best_known();
    for (const DesignSetting& s : r.front[m].settings) text += csv_text(setting_text(s.value)) + ",";
    for (std::size_t k = 0; k < r.figures.size(); ++k) {
      const DesignEstimate e = sample.figures.empty() ? DesignEstimate{NAN, NAN, NAN} : sample.figures[k];
      text += fmt::format("{},{},{},", csv_number(e.value), csv_number(e.low), csv_number(e.high));
    }
    text += fmt::format("{},{},{},{}\n", csv_number(sample.undecided.value), sample.starts, r.front[m].held_out ? 1 : 0,
                        r.chosen == m ? 1 : 0);
  }
  return text;
}

}  // namespace equipoise
