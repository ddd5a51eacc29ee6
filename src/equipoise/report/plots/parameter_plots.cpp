// Along parameters: branches of attractors, and capacities, or the balanced share over the values tried.
#include "equipoise/report/plots/plots.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/results/commands/outcome_share.hpp"

namespace equipoise {

namespace {

// A series per stretch of equal stability. Ends and changes of stability are drawn where they were located, not only at
// the next value.
std::vector<PlotSeries> stretches_of(const Branch& branch) {
  std::vector<PlotSeries> stretches;
  const auto begin = [&](bool stable) {
    stretches.push_back(
        {legend_of(branch), colour_of(branch.id), stable ? PlotSeries::Style::band : PlotSeries::Style::dashed_edges});
  };
  const auto add = [&](double value, const auto& r) { stretches.back().add(value, r.r_mean, r.r_min, r.r_max); };
  auto event = branch.events.begin();
  std::size_t last = 0;
  for (const BranchPoint& point : branch.points) {
    if (stretches.empty() || point.at != last + 1) begin(point.motion.stable);
    for (; event != branch.events.end() && event->middle() < point.value; ++event) {
      add(event->place(), *event);
      if (event->change != BranchChange::stability_gained && event->change != BranchChange::stability_lost) continue;
      begin(point.motion.stable);
      add(event->place(), *event);
    }
    add(point.value, point.motion);
    last = point.at;
  }
  for (; event != branch.events.end(); ++event) add(event->place(), *event);
  return stretches;
}

PlotSeries boundary_series(const SweepParameter& x, const std::vector<const CapacityCell*>& cells) {
  PlotSeries series;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!cells[i] || cells[i]->never) continue;
    series.add(x.values[i], cells[i]->value.value_or(cells[i]->high), cells[i]->low, cells[i]->high);
  }
  return series;
}

}  // namespace

DrawingRow branch_drawing(const BranchesResult& r) {
  Plot plot{"", axis_label(r.key), "rotor displacement r / race radius", false, true, true};
  for (const Branch& b : r.branches)
    for (PlotSeries& stretch : stretches_of(b)) plot.series.push_back(std::move(stretch));
  DrawingRow row = drawn({plot},
                         "Every motion from its smallest to its largest displacement: a band where it attracts, dashed "
                         "lines where it is unstable.");
  row.details = parameters_text(r.study, {r.key}) + (r.partial ? " (PARTIAL: stopped early)" : "");
  return row;
}

std::vector<Plot> capacity_plots(const CapacityResult& r) {
  const std::string y_label = label_with_unit(r.key, r.unit);
  std::vector<Plot> plots;
  if (r.axes.empty()) {
    Plot plot{"", y_label, fmt::format("starts that {} (%)", r.asked()), false, false, true};
    PlotSeries series{"share", dark_colour};
    for (const CapacityTrial& t : r.cells.front() ? r.cells.front()->trials : std::vector<CapacityTrial>{})
      series.add(t.value, 100.0 * t.balanced.share, 100.0 * t.balanced.low, t.unstable ? 0.0 : 100.0 * t.balanced.high);
    const double asked = 100.0 * r.at_least;
    plot.series = {
        series,
        {fmt::format("{:.4g} %", asked), light_colour, PlotSeries::Style::dashed, {r.from, r.to}, {asked, asked}}};
    return {plot};
  }
  const auto size = [&](std::size_t axis) { return axis < r.axes.size() ? r.axes[axis].size() : 1; };
  for (std::size_t third = 0; third < size(2); ++third) {
    const SweepParameter& x = r.axes[0].parameters.front();
    Plot plot{"", label_with_unit(x.key, x.unit), y_label, false, false, true};
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
      series.colour = series_colours[second % series_colours.size()];
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
