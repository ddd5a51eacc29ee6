// Pictures of a plane of two quantities: coloured squares in a square frame, as most planes are square, and borders
// over them, such as those on which a quantity known at the pixels changes sign.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/drawing/svg.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

inline constexpr int most_drawn_pixels = 640;  ///< along one side: as many as a page is wide

/// A part of the plane: "12.3 %", "less than 0.1 %", "more than 99.9 %".
std::string part_words(double part);

/// An axis of the plane: angles of balls in parts of a turn, quantities in the unit that suits the largest value,
/// others as in other pictures.
AxisWords axis_words(const Study& study, const SliceAxis& axis);

/// The two axes in CSV, in the same units.
struct PlaneColumns {
  PlaneColumns(const Study& study, const SliceAxis& x, const SliceAxis& y);
  /// With a comma between them.
  std::string values(double x, double y) const;

  std::string titles;  ///< "speed.final (rpm),balancer.drag (mN m s)"
  double x_factor, y_factor;
};

using MapPoint = std::array<double, 2>;

/// Points along a line; the last is the first again if the line is closed.
using MapLine = std::vector<MapPoint>;

/// The lines on which a field is zero, known at the centres of the pixels of two axes, row by row: by linear
/// interpolation along the edges of every cell between four centres. They break off next to undefined values. Empty if
/// the field has not a value for every pixel: it is then the same everywhere.
std::vector<MapLine> zero_line(const SliceAxis& x, const SliceAxis& y, const std::vector<float>& values);

/// Lines of one meaning.
struct Border {
  std::vector<MapLine> lines;
  SvgPen pen;
  std::string meaning;
};

/// The frame with its axes, and what its legend names so far.
struct PlanePicture {
  Svg svg;
  SvgAxes axes;
  std::vector<LegendEntry> legend;

  /// `described`: what the picture shows, for those who cannot see it.
  PlanePicture(const std::string& described, const Study& study, const SliceAxis& x, const SliceAxis& y);

  /// Covers the grid with squares; `colour`: "#rrggbb" of a column and a row, rows from below.
  void fill(int columns, int rows, const std::function<std::string(int column, int row)>& colour);
  /// Borders that the plane has, named in the legend: over what is drawn so far, light below dark to be seen on any
  /// colour.
  void draw(const std::vector<Border>& borders);
  /// With the legend below.
  std::string str();
};

}  // namespace equipoise
