// Fronts, spin-ups, margins and the search itself.
#include "equipoise/report/plots/plots.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/core/base/read_number.hpp"
#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/report/answers/design_words.hpp"

namespace equipoise {

namespace {

double shown_value(const DesignFigure& f, double value) { return f.share ? 100.0 * value : value; }

std::string unit_label(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

std::string figure_label(const DesignFigure& f) { return unit_label(f.name, f.share ? "%" : f.unit); }

// Skips infinite ends of intervals, which would leave no room for the rest.
void add_point(PlotSeries& s, double x, const DesignFigure& f, const DesignEstimate& e) {
  if (!std::isfinite(x) || !std::isfinite(e.value)) return;
  s.add(x, shown_value(f, e.value), shown_value(f, e.low), shown_value(f, std::isfinite(e.high) ? e.high : e.value));
}

const DesignCandidate* chosen_of(const DesignResult& r) { return r.chosen ? &r.front[*r.chosen] : nullptr; }

double leading_number(const StudyValue& value) { return value.string() ? number_in(*value.string()) : value.number(); }

PlotSeries limit_series(const DesignResult& r, std::size_t figure, const PlotSeries& along) {
  PlotSeries s{"must hold", light_colour, PlotSeries::Style::dashed};
  for (const DesignLimit& limit : r.limits)
    if (limit.figure == figure && !along.x.empty()) {
      const double bound = shown_value(r.figures[figure], limit.below ? *limit.below : *limit.above);
      s.x = {*std::min_element(along.x.begin(), along.x.end()), *std::max_element(along.x.begin(), along.x.end())};
      s.y = {bound, bound};
    }
  return s;
}

}  // namespace

std::vector<Plot> front_plots(const DesignResult& r) {
  std::vector<Plot> plots;
  if (r.objectives.size() < 2 || r.front.empty()) return plots;
  const DesignFigure& first = r.figures[r.objectives.front()];
  for (std::size_t g = 1; g < r.objectives.size(); ++g) {
    const std::size_t k = r.objectives[g];
    Plot plot{"", figure_label(first), figure_label(r.figures[k])};
    PlotSeries front{"not beaten by any", dark_colour, PlotSeries::Style::points};
    PlotSeries best{"chosen", chosen_colour, PlotSeries::Style::points};
    PlotSeries before{design_as_given, grey_colour, PlotSeries::Style::points};
    for (std::size_t m = 0; m < r.front.size(); ++m) {
      const DesignSample& s = r.front[m].best_known();
      if (s.figures.empty()) continue;
      const double x = shown_value(first, s.figures[r.objectives.front()].value);
      add_point(front, x, r.figures[k], s.figures[k]);
      if (r.chosen == m) add_point(best, x, r.figures[k], s.figures[k]);
    }
    if (r.before && !r.before->figures.empty())
      add_point(before, shown_value(first, r.before->figures[r.objectives.front()].value), r.figures[k],
                r.before->figures[k]);
    plot.series = {front, best};
    if (!before.x.empty()) plot.series.push_back(before);
    plots.push_back(std::move(plot));
  }
  return plots;
}

std::vector<Plot> spin_up_plots(const DesignResult& r) {
  const DesignCandidate* best = chosen_of(r);
  if (!best) return {};
  for (std::size_t k = 0; k < r.variables.size(); ++k) {
    const auto& shape = r.variables[k].spin_up;
    if (!shape) continue;
    const StudyValue& value = best->settings[k].value;
    if (!value.find("times")) return {};  // of the study itself
    PlotSeries speeds{"speed", dark_colour};
    for (const StudyValue& t : *value.find("times")->array()) speeds.x.push_back(leading_number(t));
    for (const StudyValue& s : *value.find("speeds")->array()) speeds.y.push_back(leading_number(s));
    const double top = *std::max_element(speeds.y.begin(), speeds.y.end());
    speeds.x.push_back(1.1 * shape->until);
    speeds.y.push_back(speeds.y.back());
    Plot plot{
        "",      unit_label("time", shape->time_unit), unit_label("speed", r.variables[k].unit), false, false, true,
        {speeds}};
    for (const DesignSetting& s : best->settings) {
      if (s.key != "release.time") continue;
      const double t = leading_number(s.value);
      plot.series.push_back({"balls released", light_colour, PlotSeries::Style::dashed, {t, t}, {0.0, top}});
    }
    return {plot};
  }
  return {};
}

std::vector<Plot> margin_plots(const DesignResult& r, std::size_t most) {
  std::vector<Plot> plots;
  const DesignCandidate* best = chosen_of(r);
  if (!best) return plots;
  // A variable that is itself the objective shows nothing about others; the requirements do.
  const auto is_variable = [&](const DesignFigure& f) {
    return std::any_of(r.variables.begin(), r.variables.end(),
                       [&](const DesignVariable& v) { return f.name == v.key || f.name == "-" + v.key; });
  };
  std::size_t k = r.objectives.front();
  for (std::size_t other = 0; other < r.figures.size() && is_variable(r.figures[k]); ++other)
    if (!is_variable(r.figures[other])) k = other;
  for (const DesignMargin& m : r.margins) {
    if (plots.size() == most) break;
    const bool words = std::any_of(m.points.begin(), m.points.end(),
                                   [](const DesignPoint& p) { return p.given.front() == '"' && p.value == 0.0; });
    if (m.points.empty() || words) continue;
    PlotSeries series{r.figures[k].name, dark_colour};
    bool here = false;
    for (const DesignPoint& p : m.points) {
      if (!here && p.value > m.value) add_point(series, m.value, r.figures[k], m.here.figures[k]), here = true;
      if (!p.sample.figures.empty()) add_point(series, p.value, r.figures[k], p.sample.figures[k]);
    }
    if (!here) add_point(series, m.value, r.figures[k], m.here.figures[k]);
    PlotSeries chosen{"chosen", chosen_colour, PlotSeries::Style::points};
    add_point(chosen, m.value, r.figures[k], m.here.figures[k]);
    Plot plot{
        "", unit_label(margin_name(m.key), m.unit), figure_label(r.figures[k]), false, false, false, {series, chosen}};
    if (PlotSeries limit = limit_series(r, k, series); !limit.x.empty()) plot.series.push_back(std::move(limit));
    plots.push_back(std::move(plot));
  }
  return plots;
}

std::vector<Plot> history_plots(const DesignResult& r) {
  const DesignFigure& first = r.figures[r.objectives.front()];
  PlotSeries series{"best so far", dark_colour};
  for (const DesignStep& step : r.history) {
    if (step.violation > 0.0 || !std::isfinite(step.value)) continue;
    if (!series.y.empty()) {  // as good until then
      series.x.push_back(static_cast<double>(step.trajectories));
      series.y.push_back(series.y.back());
    }
    series.x.push_back(static_cast<double>(step.trajectories));
    series.y.push_back(shown_value(first, step.value));
  }
  if (series.x.empty()) return {};
  series.x.push_back(static_cast<double>(r.trajectories));
  series.y.push_back(series.y.back());
  return {{"", "trajectories followed", figure_label(first), false, true, false, {series}}};
}

std::string design_title(const DesignResult& r) {
  std::string wanted;
  for (const std::size_t k : r.objectives)
    wanted += fmt::format("{}{} {}", wanted.empty() ? "" : ", ", r.figures[k].up ? "more" : "less",
                          r.figures[k].name.substr(r.figures[k].name.front() == '-' ? 1 : 0));
  return fmt::format("Design for {}{}", wanted, r.partial ? " (PARTIAL: stopped early)" : "");
}

}  // namespace equipoise
