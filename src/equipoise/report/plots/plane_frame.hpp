// What drawings of a plane of two quantities share: a square frame, as most planes are square, and borders over it,
// such as those on which a quantity known at the pixels changes sign.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/drawing/svg.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

inline constexpr double plane_side = 358.0;
inline constexpr SvgPoint plane_top_left{58.0, 10.0},
    plane_bottom_right{plane_top_left.x + plane_side, plane_top_left.y + plane_side};
inline constexpr double below_plane = plane_bottom_right.y + 42.0;  ///< where the legend begins
inline constexpr int most_drawn_pixels = 640;                       ///< along one side: as many as a page is wide

/// A part of the plane: "12.3 %", "< 0.1 %".
std::string part_words(double part);

using MapPoint = std::array<double, 2>;

/// Points along a line; the last is the first again if the line is closed.
using MapLine = std::vector<MapPoint>;

/// The lines on which a field is zero, by linear interpolation along the edges of every cell between four centres. They
/// break off next to undefined values. Empty if the field is the same everywhere.
std::vector<MapLine> zero_line(const BasinSlice& map, const std::vector<float>& values);
/// The same for values at the centres of the pixels of two axes, row by row.
std::vector<MapLine> zero_line(const SliceAxis& x, const SliceAxis& y, const std::vector<float>& values);

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
