// The plots of a reproduced paper.
#include "equipoise/extras/reproduction/reproduction_document.hpp"

#include <array>
#include <map>

#include <fmt/format.h>

#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

// Four colours that differ in hue and in lightness (after M. Okabe, K. Ito, Color Universal Design, 2008).
constexpr std::array four{"#0072B2", "#D55E00", "#009E73", "#E69F00"};

std::string label_of(const FigureSeries& s) {
  if (!s.label.empty()) return s.label;
  return fmt::format("{} law", name_of(s.law));
}

void add(PlotSeries& series, double x, const Share& share) {
  series.x.push_back(x);
  series.y.push_back(100.0 * share.share);
  series.low.push_back(100.0 * share.low);
  series.high.push_back(100.0 * share.high);
}

struct Curves {
  PlotSeries printed, published, kinematic;
};

// Curves of the rows that share a series, in the order of the table.
std::vector<std::pair<std::string, Curves>> curves_of(const ReproducedTable& table) {
  std::vector<std::pair<std::string, Curves>> list;
  for (const ReproducedRow& row : table.rows) {
    if (list.empty() || list.back().first != row.published->series) list.push_back({row.published->series, {}});
    Curves& c = list.back().second;
    const double x = row.published->parameter;
    c.printed.x.push_back(x);
    c.printed.y.push_back(100.0 * row.published->cells.front().share.share);
    if (row.by_published_law && row.by_published_law->starts)
      add(c.published, x, row.by_published_law->share_of("balanced"));
    if (row.by_kinematic_law && row.by_kinematic_law->starts)
      add(c.kinematic, x, row.by_kinematic_law->share_of("balanced"));
  }
  return list;
}

}  // namespace

std::optional<Plot> table_plot(const ReproducedTable& table) {
  if (table.published->number == 7) return {};
  Plot plot{"",
            table.published->parameter == "T0" ? "duration of the ramp, T0" : "final speed Ω / critical speed",
            "balanced share, %",
            table.published->number == 3,
            false,
            false,
            {}};
  const auto list = curves_of(table);
  const bool many = list.size() > 2;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const auto& [name, curves] = list[k];
    const std::string of = name.empty() ? "" : name + ": ";
    const auto style = k % 2 == 0 || many ? PlotSeries::Style::line : PlotSeries::Style::dashed;
    const auto take = [&](const PlotSeries& s, const std::string& label, const char* colour) {
      if (s.x.empty()) return;
      PlotSeries series = s;
      series.label = of + label;
      series.colour = colour;
      series.style = style;
      plot.series.push_back(std::move(series));
    };
    take(curves.published, table.published->ramps ? "published law" : "computed", many ? four[k % 4] : dark_colour);
    take(curves.kinematic, "kinematic law", light_colour);
    PlotSeries printed = curves.printed;
    printed.label = k + 1 == list.size() ? "printed" : "";
    printed.colour = "#222222";
    printed.style = PlotSeries::Style::points;
    plot.series.push_back(std::move(printed));
  }
  return plot;
}

std::vector<Plot> figure_plots(const PaperFigure& figure) {
  std::vector<Plot> plots;
  for (const FigurePanel& panel : figure.panels) {
    Plot plot{panel.title, "time t (units of 1/ω_c)", "r (race radii)", false, true, true, {}};
    for (std::size_t k = 0; k < panel.series.size(); ++k) {
      const FigureSeries& s = panel.series[k];
      plot.series.push_back(
          {label_of(s), k == 0 ? dark_colour : light_colour, PlotSeries::Style::line, s.t, s.r, {}, {}});
    }
    plots.push_back(std::move(plot));
  }
  return plots;
}

Plot plot_of_box(const OpenQuestions& open) {
  Plot plot{"", "speed Ω / critical speed", "balanced share, %", false, false, false, {}};
  PlotSeries box{"starts in the box", light_colour, PlotSeries::Style::line, {}, {}, {}, {}};
  PlotSeries rest{"starts at rest", dark_colour, PlotSeries::Style::line, {}, {}, {}, {}};
  for (const BoxShares& b : open.boxes) {
    add(box, b.speed, b.box.attractors.front().share);  // balanced is always the first
    add(rest, b.speed, b.rest.attractors.front().share);
  }
  plot.series = {rest, box};
  return plot;
}

std::string figure_csv(const PaperFigure& figure) {
  std::string text = fmt::format("# {}. {}\n", figure.title, figure.caption);
  if (!figure.choice.empty()) text += fmt::format("# {}\n", figure.choice);
  text +=
      "# r: distance of the rotor's centre from the axis, in race radii; t in 1/omega_c. Long curves are thinned to "
      "their envelope.\n";
  for (const FigurePanel& panel : figure.panels)
    for (const FigureSeries& s : panel.series) {
      text += fmt::format("# study of {}, {}:\n#   ", panel.title, label_of(s));
      for (const char c : s.study) text += c == '\n' ? std::string("\n#   ") : std::string(1, c);
      text += "\n";
    }
  text += "panel,series,law,t,r\n";
  for (const FigurePanel& panel : figure.panels)
    for (const FigureSeries& s : panel.series)
      for (std::size_t i = 0; i < s.t.size(); ++i)
        text += fmt::format("\"{}\",\"{}\",{},{},{}\n", panel.title, label_of(s), name_of(s.law), s.t[i], s.r[i]);
  return text;
}

}  // namespace equipoise
