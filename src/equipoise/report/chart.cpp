// Charts for gnuplot and for plotly.js.
#include "equipoise/report/chart.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "equipoise/report/plot_parts.hpp"

namespace equipoise {

namespace {

using Json = nlohmann::ordered_json;

// Five digits are more than a screen shows; they halve a page's size.
Json rounded(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double v : values) {
    const double scale = v == 0.0 ? 1.0 : std::pow(10.0, 5.0 - std::ceil(std::log10(std::fabs(v))));
    list.push_back(std::round(v * scale) / scale);
  }
  return list;
}

Json trace(const ChartSeries& s, bool curves) {
  const bool points = s.style == ChartSeries::Style::points;
  Json t{{"type", "scatter"},
         {"name", s.label},
         {"mode", points   ? "markers"
                  : curves ? "lines"
                           : "lines+markers"},
         {"x", rounded(s.x)},
         {"y", rounded(s.y)}};
  if (s.label.empty()) t["showlegend"] = false;
  if (points)
    t["marker"] = {{"symbol", "circle-open"}, {"size", 10}, {"color", s.colour}, {"line", {{"width", 2}}}};
  else
    t["marker"] = {{"size", 5}, {"color", s.colour}};
  t["line"] = {{"color", s.colour},
               {"width", curves ? 1.2 : 2},
               {"dash", s.style == ChartSeries::Style::dashed ? "dash" : "solid"}};
  if (!s.low.empty()) {
    std::vector<double> up, down;
    for (std::size_t i = 0; i < s.y.size(); ++i) {
      up.push_back(s.high[i] - s.y[i]);
      down.push_back(s.y[i] - s.low[i]);
    }
    t["error_y"] = {{"type", "data"},
                    {"symmetric", false},
                    {"array", rounded(up)},
                    {"arrayminus", rounded(down)},
                    {"color", s.colour},
                    {"thickness", 1},
                    {"width", 2}};
  }
  return t;
}

std::string script_of(const Chart& chart, int number) {
  std::string script, items;
  double top = 1e-12;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const ChartSeries& s = chart.series[k];
    const std::string block = fmt::format("$chart_{}_{}", number, k + 1);
    script += block + " << EOD\n";
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      script += fmt::format("{:.7g} {:.6g}", s.x[i], s.y[i]);
      if (!s.low.empty()) script += fmt::format(" {:.6g} {:.6g}", s.low[i], s.high[i]);
      script += "\n";
      top = std::max(top, s.y[i]);
    }
    script += "EOD\n";
    const std::string colour = fmt::format("linecolor rgb '{}'", s.colour);
    const std::string joint = k ? ", \\\n  " : "";
    const char* dash = s.style == ChartSeries::Style::dashed ? " dashtype (10,6)" : "";
    if (s.style == ChartSeries::Style::points)
      items += fmt::format("{}{} using 1:2 with points pointtype 6 pointsize 1.7 linewidth 1.5 {} title {}", joint,
                           block, colour, quoted(s.label));
    else if (chart.curves)
      items += fmt::format("{}{} using 1:2 with lines linewidth {} {}{} title {}", joint, block, k == 0 ? "1.4" : "1.1",
                           colour, dash, s.label.empty() ? "''" : quoted(s.label));
    else
      items += fmt::format("{}{} using 1:2 with linespoints pointtype 7 pointsize 0.7 linewidth 1.6 {}{} title {}",
                           joint, block, colour, dash, quoted(s.label));
    if (!s.low.empty())
      items += fmt::format(", \\\n  {} using 1:2:3:4 with yerrorbars pointtype 0 {} notitle", block, colour);
  }
  if (items.empty()) items = "NaN notitle";
  script += fmt::format("set title {} offset 0,-0.4\nset xlabel {} offset 0,0.4\nset ylabel {} offset 0.8,0\n",
                        quoted(chart.title), quoted(chart.x_label), quoted(chart.y_label));
  script += chart.log_x ? "set logscale x\nset format x '10^{%T}'\nset xtics enhanced\n"
                        : "unset logscale x\nset format x '%g'\n";
  const bool key = chart.series.size() > 1;
  script += chart.from_zero
                ? fmt::format("set yrange [{:.6g}:{:.6g}]\n", -0.02 * top, (key && chart.curves ? 1.28 : 1.08) * top)
                : std::string("set yrange [*:*]\nset offsets graph 0, graph 0, graph 0.08, graph 0.08\n");
  script += chart.curves ? "set xrange [*:*] noextend\n" : "set xrange [*:*]\n";
  script += !key           ? "unset key\n"
            : chart.curves ? "set key inside top right horizontal samplen 1.6\n"
                           : "set key outside bottom center horizontal samplen 2.5\n";
  return script + "plot " + items + "\n";
}

}  // namespace

nlohmann::ordered_json plotly_json(const Chart& chart) {
  Json data = Json::array();
  for (const ChartSeries& s : chart.series) data.push_back(trace(s, chart.curves));
  Json y{{"title", {{"text", chart.y_label}}}, {"automargin", true}, {"zeroline", false}};
  if (chart.from_zero) y["rangemode"] = "tozero";
  Json x{{"title", {{"text", chart.x_label}}}, {"automargin", true}, {"zeroline", false}};
  if (chart.log_x) {
    x["type"] = "log";
    x["exponentformat"] = "power";
  }
  return {{"data", data},
          {"layout",
           {{"margin", {{"l", 55}, {"r", 12}, {"t", 12}, {"b", 45}}},
            {"xaxis", x},
            {"yaxis", y},
            {"hovermode", "closest"},
            {"showlegend", chart.series.size() > 1},
            {"legend", {{"orientation", "h"}, {"x", 0}, {"y", 1}, {"yanchor", "bottom"}}}}}};
}

std::string chart_plot_script(const std::string& title, const std::vector<Chart>& charts, const std::string& path) {
  const int count = static_cast<int>(charts.size()), columns = std::min(count, 2);
  const int rows = (count + columns - 1) / std::max(columns, 1);
  const int row_height = charts.empty() || charts.front().curves ? 420 : 600;
  std::string script = canvas(path, 1600, 90 + std::max(rows * row_height, 560)) + quiet_frame;
  script += "set lmargin 10\n";
  script += fmt::format("set multiplot layout {},{} title {}\n", rows, columns, quoted(title));
  for (int k = 0; k < count; ++k) script += script_of(charts[static_cast<std::size_t>(k)], k + 1);
  return script + "unset multiplot\n";
}

}  // namespace equipoise
