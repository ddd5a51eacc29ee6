// Charts as drawings that stand in a page: they need no script, and follow its colours by day and by night.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "equipoise/drawing/chart.hpp"
#include "equipoise/drawing/svg.hpp"

namespace equipoise {

/// What drawings of this kind share: their width, where their axes begin and end, and how tall they are without a
/// legend.
inline constexpr double drawing_width = 430.0, drawing_height = 268.0;
inline constexpr SvgPoint drawing_top_left{58.0, 14.0}, drawing_bottom_right{416.0, 226.0};

/// Colours with their names from `top` on, two beside each other where they are short; the room that they take.
using LegendEntry = std::pair<std::string, std::string>;  // colour, name
double legend_height(const std::vector<LegendEntry>& entries);
void draw_legend(Svg& svg, double top, const std::vector<LegendEntry>& entries);

/// A chart with linear axes: lines, or points, with intervals as strokes. `described`: for who cannot see it.
std::string chart_svg(const Chart& chart, const std::string& described);

}  // namespace equipoise
