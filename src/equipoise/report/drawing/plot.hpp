// Plots as data, drawn as SVG (plot_svg.hpp).
#pragma once

#include <string>
#include <vector>

namespace equipoise {

struct PlotSeries {
  enum class Style { line, dashed, points };
  std::string label;
  std::string colour;
  Style style = Style::line;
  std::vector<double> x, y;
  std::vector<double> low, high;  ///< ends of intervals; empty if there are none
};

struct Plot {
  std::string title, x_label, y_label;
  bool log_x = false;
  bool curves = false;  ///< thin lines without markers
  bool from_zero = false;
  std::vector<PlotSeries> series;
};

}  // namespace equipoise
