// Stacked areas, heat maps, peaks along a parameter.
#include "equipoise/report/plots/plots.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/drawing/plot_parts.hpp"

namespace equipoise {

namespace {

// Indices of the values in rising order.
std::vector<std::size_t> rising(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

// The finished cells of a sweep along one axis, by value.
std::vector<std::size_t> cells_along(const SweepResult& r) {
  std::vector<std::size_t> cells;
  for (const std::size_t k : rising(r.axes.front().parameters.front().values))
    if (r.cells[k]) cells.push_back(k);
  return cells;
}

// A quantile of a cell's peak displacements with finite ends: with few starts the interval ends at the largest.
QuantileEstimate peak_quantile(const SweepResult& r, std::size_t cell, std::size_t quantile) {
  const SampleSummary& figure = r.cells[cell]->transients->figure(&TransientRow::peak_radial);
  QuantileEstimate estimate = figure.quantiles[quantile];
  if (!std::isfinite(estimate.high)) estimate.high = figure.largest;
  return estimate;
}

std::vector<std::string> heat_labels(const SweepParameter& p, const std::vector<std::size_t>& order) {
  std::vector<std::string> labels;
  labels.reserve(order.size());
  for (const std::size_t k : order) labels.push_back(fmt::format("{:.4g}", p.values[k]));
  return labels;
}

void draw_scale(Svg& svg, double top) {
  constexpr double left = 130.0, right = 344.0;
  constexpr int steps = 40;
  for (int k = 0; k < steps; ++k) {
    const double from = left + (right - left) * k / steps;
    svg.rectangle({from, top}, (right - left) / steps + 0.5, 9.0, {"", heat_colour((k + 0.5) / steps)});
  }
  svg.text({left - 6.0, top + 9.0}, "balanced: 0 %", SvgAnchor::end, quiet_ink);
  svg.text({right + 6.0, top + 9.0}, "100 %", SvgAnchor::start, quiet_ink);
}

void draw_cell(Svg& svg, const SvgAxes& axes, double column, double row, double share) {
  const SvgPoint corner = axes.at(column, row + 1.0), end = axes.at(column + 1.0, row);
  const double width = end.x - corner.x, height = end.y - corner.y;
  // Slightly larger than the cell, so that the page does not show through between neighbours.
  svg.rectangle(corner, width + 0.3, height + 0.3, {"", heat_colour(share)});
  constexpr double least_width = 22.0, least_height = 11.0, light = 0.55;
  if (width < least_width || height < least_height) return;
  svg.text({corner.x + 0.5 * width, corner.y + 0.5 * height + 3.5}, fmt::format("{:.0f}", 100.0 * share),
           SvgAnchor::middle, share > light ? "#000000" : "#ffffff", 10.0);
}

std::string stacked_svg(const SweepResult& r) {
  const std::vector<SweepLayer> layers = sweep_layers(r);
  const std::vector<std::size_t> cells = cells_along(r);
  std::vector<LegendEntry> entries;
  for (const SweepLayer& layer : layers) entries.push_back({{"", layer.colour}, layer.name});
  if (!cells.empty()) entries.push_back({{"#1b1f24", "", 1.5}, "balanced: 95 % interval", LegendEntry::Mark::line});
  Svg svg(drawing_width, drawing_height, "Shares of starts by outcome along the parameter");
  const SweepParameter& p = r.axes.front().parameters.front();
  std::vector<double> x, sum(cells.size(), 0.0);
  for (const std::size_t k : cells) x.push_back(p.values[k]);
  const bool lone = x.size() == 1;
  const AxisExtent across = x.empty() ? AxisExtent() : widened(AxisExtent{x.front(), x.back()}, lone ? 0.0 : 0.02);
  SvgAxes axes(svg, drawing_top_left, drawing_bottom_right, across, {0.0, 100.0}, {label_with_unit(p.key, p.unit)},
               {"share of starts, %"});
  for (const SweepLayer& layer : layers) {
    std::vector<double> next = sum;
    for (std::size_t i = 0; i < cells.size(); ++i) next[i] += 100.0 * layer.share[cells[i]];
    if (lone)
      axes.bar(across.low, across.high, sum[0], next[0], {"", layer.colour});
    else
      axes.band(x, sum, next, {layer.colour, layer.colour, 0.4});
    sum = next;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Share& balanced = r.cells[cells[i]]->outcomes.front().share;
    // Dark on light: visible on any layer.
    for (const SvgPen& pen : {SvgPen{"#ffffff", "", 3.2, 0.8}, SvgPen{"#1b1f24", "", 1.5}})
      svg.line(axes.at(x[i], 100.0 * balanced.low), axes.at(x[i], 100.0 * balanced.high), pen);
  }
  draw_legend(svg, entries);
  return svg.str();
}

std::string heat_svg(const SweepResult& r, std::size_t first) {
  const SweepParameter& y = r.axes[r.axes.size() - 2].parameters.front();
  const SweepParameter& x = r.axes.back().parameters.front();
  const std::vector<std::size_t> columns = rising(x.values), rows = rising(y.values);
  constexpr double scale_top = 282.0;
  Svg svg(drawing_width, scale_top + 16.0, "Balanced share of the starts over two parameters");
  const SvgAxes axes(svg, {58.0, 10.0}, {416.0, 236.0}, {0.0, static_cast<double>(columns.size())},
                     {0.0, static_cast<double>(rows.size())},
                     {label_with_unit(x.key, x.unit), 1.0, false, "", heat_labels(x, columns)},
                     {label_with_unit(y.key, y.unit), 1.0, false, "", heat_labels(y, rows)});
  for (std::size_t j = 0; j < rows.size(); ++j)
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (const auto& cell = r.cells[first + rows[j] * columns.size() + columns[i]])
        draw_cell(svg, axes, static_cast<double>(i), static_cast<double>(j), cell->outcomes.front().share.share);
  draw_scale(svg, scale_top);
  return svg.str();
}

// One table for each value of the first axis.
void add_heat_maps(DrawingRow& row, const SweepResult& r) {
  const SweepParameter& outer = r.axes.front().parameters.front();
  const std::size_t cells = r.cells.size() / outer.values.size();
  constexpr std::size_t most = 12;
  for (std::size_t k = 0; k < std::min(outer.values.size(), most); ++k)
    row.drawings.push_back(
        {key_words(outer.key) + " " + value_words(outer.key, outer.given[k]), heat_svg(r, k * cells), "", ""});
  if (outer.values.size() > most)
    row.caption +=
        fmt::format(" {} more values of {} are not drawn.", outer.values.size() - most, key_words(outer.key));
}

}  // namespace

std::vector<SweepLayer> sweep_layers(const SweepResult& r) {
  constexpr int last = 1'000'000;  // after all identifiers
  std::map<int, SweepLayer> layers;
  for (std::size_t k = 0; k < r.cells.size(); ++k) {
    if (!r.cells[k]) continue;
    const SweepCell& cell = *r.cells[k];
    const auto add = [&](int order, const std::string& name, int code, double share) {
      SweepLayer& layer = layers.try_emplace(order, SweepLayer{name, colour_of(code), {}}).first->second;
      layer.share.resize(r.cells.size());
      layer.share[k] = share;
    };
    for (const SweepOutcome& o : cell.outcomes)
      if (o.share.count > 0 || o.id == balanced_id) add(o.id, legend_of(o), o.id, o.share.share);
    for (const auto& [outcome, order] : {std::pair{OutcomeKind::stalled, last}, {OutcomeKind::undecided, last + 1}}) {
      const NoAttractor& n = told_of(outcome);
      if (const Share* s = cell.of(n.code); s && s->count > 0) add(order, n.name, n.code, s->share);
    }
    if (cell.lost() > 0) add(last + 2, "diverged or failed", diverged_code, cell.diverged.share + cell.failed.share);
  }
  std::vector<SweepLayer> list;
  for (auto& [order, layer] : layers) list.push_back(std::move(layer));
  return list;
}

DrawingRow sweep_drawing(const SweepResult& r) {
  DrawingRow row;
  row.size = r.axes.size() < 3 ? DrawingSize::wide : DrawingSize::large;
  row.caption = r.axes.size() == 1 ? "Shares of starts, stacked; strokes: 95 % interval of the balanced share."
                                   : "Balanced share of the starts in every cell, in per cent where there is room.";
  if (r.axes.size() == 1)
    row.drawings.push_back({"", stacked_svg(r)});
  else if (r.axes.size() == 2)
    row.drawings.push_back({"", heat_svg(r, 0)});
  else
    add_heat_maps(row, r);
  row.details = parameters_text(r.study, keys_of(r.axes)) + (r.complete() ? "" : " (PARTIAL: cells are missing)");
  return row;
}

std::optional<Plot> peak_plot(const SweepResult& r) {
  if (!r.transients || r.axes.size() != 1) return std::nullopt;
  const std::vector<std::size_t> cells = cells_along(r);
  const SweepParameter& p = r.axes.front().parameters.front();
  const TransientFigure& figure = transient_figures[figure_place(&TransientRow::peak_radial)];
  double largest = r.study.limits.displacement.value_or(0.0);
  for (const std::size_t cell : cells) largest = std::max(largest, peak_quantile(r, cell, 1).high);
  const AxisWords words = PageQuantities(r.study).axis(figure.title, largest, *figure.dimension);
  Plot plot{"", label_with_unit(p.key, p.unit), words.label, false, false, true};
  const auto add = [&](std::size_t quantile, const char* name, const char* colour) {
    PlotSeries series{name, colour};
    for (const std::size_t cell : cells) {
      const QuantileEstimate estimate = peak_quantile(r, cell, quantile);
      series.add(p.values[cell], estimate.value * words.factor, estimate.low * words.factor,
                 estimate.high * words.factor);
    }
    plot.series.push_back(std::move(series));
  };
  add(0, "median", dark_colour);
  add(1, "90 % of starts stay below", light_colour);
  if (const auto& limit = r.study.limits.displacement; limit && !cells.empty()) {
    const double at = *limit * words.factor;
    const std::vector<double> ends{p.values[cells.front()], p.values[cells.back()]};
    plot.series.push_back({"limit", limit_colour, PlotSeries::Style::dashed, ends, {at, at}});
  }
  return plot;
}

}  // namespace equipoise
