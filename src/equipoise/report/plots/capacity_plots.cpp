// Boundaries along parameters, or the balanced share over the values tried.
#include "equipoise/report/plots/capacity_plots.hpp"

#include <array>

#include <fmt/format.h>

#include "equipoise/report/drawing/plot_parts.hpp"

namespace equipoise {

namespace {

std::string label_of(const std::string& key, const std::string& unit) {
  return unit.empty() ? axis_label(key) : fmt::format("{} ({})", key, unit);
}

PlotSeries boundary_series(const SweepParameter& x, const std::vector<const CapacityCell*>& cells) {
  PlotSeries series;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!cells[i] || cells[i]->never) continue;
    series.x.push_back(x.values[i]);
    series.y.push_back(cells[i]->value.value_or(cells[i]->high));
    series.low.push_back(cells[i]->low);
    series.high.push_back(cells[i]->high);
  }
  return series;
}

}  // namespace

std::string capacity_title(const CapacityResult& r) {
  return fmt::format("Largest {} at which {:.4g} % of starts {}{}", r.key, 100.0 * r.at_least, r.asked(),
                     r.complete() ? "" : " (PARTIAL: stopped early)");
}

std::vector<Plot> capacity_plots(const CapacityResult& r) {
  // Distinct for any kind of colour vision, as in other pictures.
  constexpr std::array colours{"#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#666666"};
  const std::string y_label = label_of(r.key, r.unit);
  std::vector<Plot> plots;
  if (r.axes.empty()) {
    Plot plot{"", y_label, "balanced (%)", false, false, true, {}};
    PlotSeries series{"balanced share", dark_colour, PlotSeries::Style::line, {}, {}, {}, {}};
    for (const CapacityTrial& t : r.cells.front() ? r.cells.front()->trials : std::vector<CapacityTrial>{}) {
      series.x.push_back(t.value);
      series.y.push_back(100.0 * t.balanced.share);
      series.low.push_back(100.0 * t.balanced.low);
      series.high.push_back(t.unstable ? 0.0 : 100.0 * t.balanced.high);
    }
    PlotSeries asked{fmt::format("{:.4g} %", 100.0 * r.at_least),
                     light_colour,
                     PlotSeries::Style::dashed,
                     {r.from, r.to},
                     {100.0 * r.at_least, 100.0 * r.at_least},
                     {},
                     {}};
    plot.series = {series, asked};
    return {plot};
  }
  const auto size = [&](std::size_t axis) { return axis < r.axes.size() ? r.axes[axis].size() : 1; };
  for (std::size_t third = 0; third < size(2); ++third) {
    const SweepParameter& x = r.axes[0].parameters.front();
    Plot plot{"", label_of(x.key, x.unit), y_label, false, false, true, {}};
    if (r.axes.size() > 2) {
      const SweepParameter& p = r.axes[2].parameters.front();
      plot.title = fmt::format("{} = {}", p.key, p.given[third]);
    }
    for (std::size_t second = 0; second < size(1); ++second) {
      std::vector<const CapacityCell*> cells;
      for (std::size_t i = 0; i < size(0); ++i) {
        const auto& cell = r.cells[(i * size(1) + second) * size(2) + third];
        cells.push_back(cell ? &*cell : nullptr);
      }
      PlotSeries series = boundary_series(x, cells);
      series.colour = colours[second % colours.size()];
      if (r.axes.size() > 1) {
        const SweepParameter& p = r.axes[1].parameters.front();
        series.label = fmt::format("{} = {}", p.key, p.given[second]);
      }
      plot.series.push_back(std::move(series));
    }
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace equipoise
