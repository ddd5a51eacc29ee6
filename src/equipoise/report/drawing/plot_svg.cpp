// Axes that contain all values with their intervals, series, legend.
#include "equipoise/report/drawing/plot_svg.hpp"

#include <algorithm>
#include <limits>

namespace equipoise {

namespace {

constexpr double legend_left = 14.0, legend_name = 16.0, legend_line = 13.0;

// Names in lines that fit into `columns`.
std::vector<std::vector<std::string>> names_in(std::size_t columns, const std::vector<LegendEntry>& entries,
                                               double column) {
  std::vector<std::vector<std::string>> names;
  for (const LegendEntry& e : entries)
    names.push_back(text_lines(e.name, column / static_cast<double>(columns) - legend_name));
  return names;
}

void draw_mark(Svg& svg, const LegendEntry& entry, SvgPoint at) {
  const SvgPen& pen = entry.pen;
  switch (entry.mark) {
    case LegendEntry::Mark::square:
      return svg.rectangle(at, 10.0, 10.0,
                           {pen.stroke.empty() ? "var(--swatch-edge)" : pen.stroke, pen.fill, 1.0, pen.opacity});
    case LegendEntry::Mark::line:
      return svg.line({at.x - 4.0, at.y + 5.0}, {at.x + 12.0, at.y + 5.0}, pen);
    case LegendEntry::Mark::ring:
      return svg.circle({at.x + 5.0, at.y + 5.0}, 3.5, pen);
    case LegendEntry::Mark::none:
      return;
  }
}

struct PlotExtents {
  AxisExtent x, y;
};

PlotExtents extents_of(const Plot& plot) {
  constexpr double most = std::numeric_limits<double>::infinity();
  AxisExtent x{most, -most}, y{most, -most};
  const auto hold = [](AxisExtent& extent, double value) {
    extent.low = std::min(extent.low, value);
    extent.high = std::max(extent.high, value);
  };
  for (const PlotSeries& s : plot.series)
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      hold(x, s.x[i]);
      for (const double value : {s.y[i], s.low.empty() ? s.y[i] : s.low[i], s.high.empty() ? s.y[i] : s.high[i]})
        hold(y, value);
    }
  if (x.low > x.high) return {};
  PlotExtents extents{widened(x, 0.04), widened(y, 0.06)};
  if (plot.curves && x.high > x.low) extents.x = x;
  if (plot.log_x) extents.x = {x.low / 2.0, 2.0 * x.high};
  if (plot.from_zero && y.low >= 0.0) extents.y.low = 0.0;
  return extents;
}

bool covers(const PlotSeries& s) { return s.style == PlotSeries::Style::line; }

constexpr double band_opacity = 0.25;

void draw_edges(Svg& svg, SvgAxes& axes, const PlotSeries& s) {
  if (s.style == PlotSeries::Style::band) axes.band(s.x, s.low, s.high, {"", s.colour, 1.0, band_opacity});
  for (const std::vector<double>* edge : {&s.low, &s.high})
    if (s.x.size() == 1)
      svg.circle(axes.at(s.x.front(), edge->front()), 2.0, {"", s.colour});
    else
      axes.line(s.x, *edge, {s.colour, "", s.is_dashed() ? 1.1 : 1.6, 1.0, s.is_dashed()});
}

LegendEntry legend_entry(const PlotSeries& s) {
  using Mark = LegendEntry::Mark;
  if (s.style == PlotSeries::Style::band) return {{s.colour, s.colour, 1.0, 2.0 * band_opacity}, s.label, Mark::square};
  const bool points = s.style == PlotSeries::Style::points;
  return {{s.colour, "", points ? 1.0 : 2.0, 1.0, s.is_dashed()}, s.label, points ? Mark::ring : Mark::line};
}

// `above`: number of lines drawn over this one. It is that much wider, to show where they coincide.
void draw_series(Svg& svg, const SvgAxes& axes, const PlotSeries& s, std::size_t above, bool curve) {
  const bool points = s.style == PlotSeries::Style::points, dashed = s.is_dashed();
  std::vector<SvgPoint> way;
  for (std::size_t i = 0; i < s.x.size(); ++i) way.push_back(axes.at(s.x[i], s.y[i]));
  const double wider = curve ? -0.4 : 1.2 * static_cast<double>(std::min<std::size_t>(above, 2));
  if (!points) svg.path(way, {s.colour, "", 1.6 + wider, 1.0, dashed});
  for (std::size_t i = 0; i < s.low.size(); ++i) {
    const SvgPoint low = axes.at(s.x[i], s.low[i]), high = axes.at(s.x[i], s.high[i]);
    svg.line(low, high, {s.colour, "", 1.3});
    for (const SvgPoint& end : {low, high}) svg.line({end.x - 3.0, end.y}, {end.x + 3.0, end.y}, {s.colour, "", 1.3});
  }
  if (!dashed && !curve)
    for (const SvgPoint& at : way) svg.circle(at, points ? 3.5 : 2.4, {points ? s.colour : "", points ? "" : s.colour});
}

}  // namespace

void draw_legend(Svg& svg, const std::vector<LegendEntry>& entries) {
  const double width = svg.width() - legend_left;
  std::size_t columns = 2;
  auto names = names_in(columns, entries, width);
  const auto is_long = [](const std::vector<std::string>& lines) { return lines.size() > 1; };
  if (entries.size() < 2 || std::any_of(names.begin(), names.end(), is_long))
    names = names_in(columns = 1, entries, width);
  double y = svg.height() + 6.0;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const double x = legend_left + width * static_cast<double>(k % columns) / static_cast<double>(columns);
    draw_mark(svg, entries[k], {x, y});
    double base = y + 9.0;
    for (const std::string& line : names[k]) {
      svg.text({x + legend_name, base}, line);
      base += legend_line;
    }
    if (k + 1 == entries.size() || (k + 1) % columns == 0) y = base - 6.0;
  }
  if (!entries.empty()) svg.grow(y - svg.height());
}

std::string plot_svg(const Plot& plot, const std::string& described, double width) {
  std::vector<LegendEntry> entries;
  for (const PlotSeries& s : plot.series)
    if (!s.label.empty() && (plot.series.size() > 1 || plot.title.empty()) &&
        std::none_of(entries.begin(), entries.end(), [&](const LegendEntry& e) { return e.name == s.label; }))
      entries.push_back(legend_entry(s));
  Svg svg(width, drawing_height, described);
  const PlotExtents extents = extents_of(plot);
  SvgAxes axes(svg, drawing_top_left, {drawing_bottom_right.x + width - drawing_width, drawing_bottom_right.y},
               extents.x, extents.y, {plot.x_label, 1.0, plot.log_x}, {plot.y_label});
  auto above = static_cast<std::size_t>(std::count_if(plot.series.begin(), plot.series.end(), covers));
  for (const PlotSeries& s : plot.series) {
    above -= covers(s);
    if (!s.label.empty()) svg.group(s.label);
    if (s.has_edges())
      draw_edges(svg, axes, s);
    else
      draw_series(svg, axes, s, above, plot.curves);
    if (!s.label.empty()) svg.end_group();
  }
  draw_legend(svg, entries);
  return svg.str();
}

DrawingRow drawn(const std::vector<Plot>& plots, const std::string& caption, bool may_be_wide) {
  constexpr double wide = 500.0;
  DrawingRow row;
  const bool alone = may_be_wide && plots.size() == 1;
  row.size = alone ? DrawingSize::wide : DrawingSize::large;
  for (const Plot& plot : plots)
    row.drawings.push_back({plot.title, plot_svg(plot, caption, alone ? wide : drawing_width), "", ""});
  row.caption = caption;
  return row;
}

}  // namespace equipoise
