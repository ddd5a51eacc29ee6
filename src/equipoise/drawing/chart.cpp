// Charts for gnuplot.
#include "equipoise/drawing/chart.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/drawing/plot_parts.hpp"

namespace equipoise {

namespace {

std::string data_block(const ChartSeries& s, const std::string& name) {
  std::string block = name + " << EOD\n";
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    block += fmt::format("{:.7g} {:.6g}", s.x[i], s.y[i]);
    if (!s.low.empty()) block += fmt::format(" {:.6g} {:.6g}", s.low[i], s.high[i]);
    block += "\n";
  }
  return block + "EOD\n";
}

// How a series is drawn. Intervals are plain strokes: error bars would interrupt the lines at their points.
std::string plot_items(const ChartSeries& s, const std::string& block, bool curves, bool first) {
  const std::string colour = fmt::format("linecolor rgb '{}'", s.colour);
  const char* dash = s.style == ChartSeries::Style::dashed ? " dashtype (10,6)" : "";
  const std::string title = quoted(s.label);
  if (s.style == ChartSeries::Style::points)
    return fmt::format("{} using 1:2 with points pointtype 6 pointsize 1.7 linewidth 1.5 {} title {}", block, colour,
                       title);
  if (curves)
    return fmt::format("{} using 1:2 with lines linewidth {} {}{} title {}", block, first ? "1.4" : "1.1", colour, dash,
                       title);
  std::string items = fmt::format("{} using 1:2 with lines linewidth 1.6 {}{} title {}", block, colour, dash, title);
  items += fmt::format(", \\\n  {} using 1:2 with points pointtype 7 pointsize 0.7 {} notitle", block, colour);
  if (!s.low.empty())
    items +=
        fmt::format(", \\\n  {} using 1:3:(0):($4-$3) with vectors nohead linewidth 1.2 {} notitle", block, colour);
  return items;
}

// Ranges are written with six digits, and their two ends must differ.
double room_between(double low, double high) {
  const double size = std::max(std::fabs(low), std::fabs(high));
  return high - low > 1e-4 * size ? high - low : std::max(0.1 * size, 1e-6);
}

// Ranges slightly wider than the data; gnuplot's own would put points on the frame.
std::string ranges(const Chart& chart) {
  double left = 1e300, right = -1e300, low = 1e300, high = -1e300;
  for (const ChartSeries& s : chart.series)
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      left = std::min(left, s.x[i]);
      right = std::max(right, s.x[i]);
      low = std::min(low, s.low.empty() ? s.y[i] : s.low[i]);
      high = std::max(high, s.high.empty() ? s.y[i] : s.high[i]);
    }
  if (left > right) return "set xrange [0:1]\nset yrange [0:1]\n";
  if (chart.from_zero) low = 0.0;
  const double pad = 0.05 * room_between(low, high);
  const double margin = chart.curves && right > left ? 0.0 : 0.02 * room_between(left, right);
  const double room = chart.curves && chart.series.size() > 1 ? 5.0 * pad : pad;  // for the legend inside
  if (chart.log_x)
    return fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", left / 2.0, 2.0 * right, low - pad,
                       high + room);
  return fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", left - margin, right + margin,
                     low - pad, high + room);
}

std::string script_of(const Chart& chart, int number) {
  std::string script, items;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const std::string block = fmt::format("$chart_{}_{}", number, k + 1);
    script += data_block(chart.series[k], block);
    items += (k ? ", \\\n  " : "") + plot_items(chart.series[k], block, chart.curves, k == 0);
  }
  if (items.empty()) items = "NaN notitle";
  script += fmt::format("set title {} offset 0,-0.4\nset xlabel {} offset 0,0.4\nset ylabel {} offset 0.8,0\n",
                        quoted(chart.title), quoted(chart.x_label), quoted(chart.y_label));
  script += chart.log_x ? "set logscale x\nset format x '%g'\n" : "unset logscale x\n";
  script += ranges(chart);
  script += chart.series.size() < 2 ? "unset key\n"
            : chart.curves          ? "set key inside top right horizontal samplen 1.6\n"
                                    : "set key outside top center horizontal samplen 2.5\n";
  return script + "plot " + items + "\n";
}

}  // namespace

std::string chart_plot_script(const std::string& title, const std::vector<Chart>& charts, const std::string& path) {
  const int count = static_cast<int>(charts.size()), columns = std::min(count, 2);
  const int rows = (count + columns - 1) / std::max(columns, 1);
  const int row_height = charts.empty() || charts.front().curves ? 420 : 600;
  std::string script = canvas(path, 1600, 90 + std::max(rows * row_height, 560)) + quiet_frame;
  double largest = 0.0;  // its digits need room on the left
  for (const Chart& chart : charts)
    for (const ChartSeries& s : chart.series)
      for (const double y : s.y) largest = std::max(largest, std::fabs(y));
  script += largest < 1e4 ? "set lmargin 10\n" : "set lmargin 14\n";
  script += fmt::format("set multiplot layout {},{} title {}\n", rows, columns, quoted(title));
  for (int k = 0; k < count; ++k) script += script_of(charts[static_cast<std::size_t>(k)], k + 1);
  return script + "unset multiplot\n";
}

}  // namespace equipoise
