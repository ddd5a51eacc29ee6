// Plots as SVG drawings in a page: they need no script and follow the page's light and dark colours.
#pragma once

#include <string>
#include <vector>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/drawing/plot.hpp"
#include "equipoise/report/drawing/svg.hpp"

namespace equipoise {

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

/// Plots beside each other.
DrawingRow drawn(const std::vector<Plot>& plots, const std::string& title, const std::string& caption,
                 bool may_be_wide);

}  // namespace equipoise
