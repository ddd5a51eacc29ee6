// Plots as data and as SVG drawings, in a page, whose light and dark colours they follow, or as files.
#pragma once

#include <string>
#include <vector>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/drawing/svg.hpp"

namespace equipoise {

struct PlotSeries {
  /// Of a band and of dashed edges, `low` and `high` are the edges.
  enum class Style { line, dashed, points, band, dashed_edges };
  std::string label{};
  std::string colour{};
  Style style = Style::line;
  std::vector<double> x{}, y{};
  std::vector<double> low{}, high{};  ///< ends of intervals; empty if there are none

  bool has_edges() const { return style == Style::band || style == Style::dashed_edges; }
  bool is_dashed() const { return style == Style::dashed || style == Style::dashed_edges; }
  void add(double at, double value, double lower, double upper) {
    x.push_back(at);
    y.push_back(value);
    low.push_back(lower);
    high.push_back(upper);
  }
};

struct Plot {
  std::string title{}, x_label{}, y_label{};
  bool log_x = false;
  bool curves = false;  ///< thin lines without markers
  bool from_zero = false;
  std::vector<PlotSeries> series{};
};

/// Common to these drawings: their width, the corners of their axes, and their height without a legend.
inline constexpr double drawing_width = 430.0, drawing_height = 268.0;
inline constexpr SvgPoint drawing_top_left{58.0, 14.0}, drawing_bottom_right{416.0, 226.0};

/// Names of colours and lines, over the whole width, two to a row if all are short.
struct LegendEntry {
  SvgPen pen;
  std::string name;
  enum class Mark { square, line, ring, none } mark = Mark::square;
};
/// Below what is drawn so far: the picture grows.
void draw_legend(Svg& svg, const std::vector<LegendEntry>& entries);

/// Lines or points, with intervals as strokes; each shows its name where the mouse rests on it. One series below a
/// title has no legend. `described`: text for those who cannot see it.
std::string plot_svg(const Plot& plot, const std::string& described, double width = drawing_width);

/// Plots next to each other.
DrawingRow drawn(const std::vector<Plot>& plots, const std::string& caption, bool may_be_wide = true);

}  // namespace equipoise
