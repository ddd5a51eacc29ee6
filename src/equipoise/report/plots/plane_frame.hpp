// What drawings of a plane of two quantities share: a square frame, as most planes are square, and borders over it.
#pragma once

#include <string>
#include <vector>

#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/drawing/svg.hpp"
#include "equipoise/report/plots/zero_line.hpp"

namespace equipoise {

inline constexpr double plane_side = 358.0;
inline constexpr SvgPoint plane_top_left{58.0, 10.0},
    plane_bottom_right{plane_top_left.x + plane_side, plane_top_left.y + plane_side};
inline constexpr double below_plane = plane_bottom_right.y + 42.0;  ///< where the legend begins
inline constexpr int most_drawn_pixels = 640;                       ///< along one side: as many as a page is wide

/// A part of the plane: "12.3 %", "< 0.1 %".
std::string part_words(double part);

/// Lines of one meaning.
struct Border {
  std::vector<MapLine> lines;
  SvgPen pen;
  std::string meaning;
};
/// Borders that a plane has: in its legend, and over what is drawn so far, light below dark to be seen on any colour.
void add_to_legend(std::vector<LegendEntry>& legend, const std::vector<Border>& borders);
void draw_borders(Svg& svg, const SvgAxes& axes, const std::vector<Border>& borders);

}  // namespace equipoise
