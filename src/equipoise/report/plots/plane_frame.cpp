// Crossings of zero between neighbouring pixels; a plane with its borders.
#include "equipoise/report/plots/plane_frame.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/report/text/csv.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/study/echo/given_value.hpp"

namespace equipoise {

namespace {

constexpr double plane_side = 358.0;
constexpr SvgPoint plane_top_left{58.0, 10.0},
    plane_bottom_right{plane_top_left.x + plane_side, plane_top_left.y + plane_side};
constexpr double below_plane = plane_bottom_right.y + 42.0;  // where the legend begins

// A field known at the pixels' centres, extrapolated linearly to the edges.
class MapField {
 public:
  MapField(const SliceAxis& x, const SliceAxis& y, const std::vector<float>& values) : x_(x), y_(y), values_(values) {}

  double value(int column, int row) const {
    const Weights a = weights(column, x_.pixels), b = weights(row, y_.pixels);
    double sum = 0.0;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        if (a.share[i] * b.share[j] != 0.0) sum += a.share[i] * b.share[j] * values_[at(a.pixel[i], b.pixel[j])];
    // A change of sign that is only extrapolated does not count.
    const double nearest = values_[at(a.pixel[0], b.pixel[0])];
    return (sum < 0.0) == (nearest < 0.0) ? sum : nearest;
  }
  MapPoint place(int column, int row) const { return {along(x_, column), along(y_, row)}; }

 private:
  struct Weights {
    int pixel[2];
    double share[2];
  };
  static Weights weights(int k, int pixels) {
    const int inside = std::clamp(k, 0, pixels - 1);
    if (k == inside || pixels == 1) return {{inside, inside}, {1.0, 0.0}};
    return {{inside, k < 0 ? 1 : pixels - 2}, {1.5, -0.5}};  // half a pixel beyond the last centre
  }
  static double along(const SliceAxis& axis, int k) { return std::clamp(axis.centre(k), axis.low, axis.high); }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(x_.pixels) + static_cast<std::size_t>(column);
  }
  const SliceAxis& x_;
  const SliceAxis& y_;
  const std::vector<float>& values_;
};

// Where the line crosses an edge between two centres, and the edges that it crosses next: one or two.
struct Crossing {
  MapPoint at;
  std::vector<long> next;
};

// Goes on from edge to edge until the line ends or closes. Ways that were gone are removed.
MapLine followed(std::map<long, Crossing>& crossings, long edge) {
  MapLine line{crossings[edge].at};
  for (std::vector<long>* ways = &crossings[edge].next; !ways->empty(); ways = &crossings[edge].next) {
    const long next = ways->back();
    ways->pop_back();
    std::vector<long>& back = crossings[next].next;
    back.erase(std::find(back.begin(), back.end(), edge));
    line.push_back(crossings[next].at);
    edge = next;
  }
  return line;
}

}  // namespace

std::vector<MapLine> zero_line(const SliceAxis& x, const SliceAxis& y, const std::vector<float>& values) {
  if (values.size() != static_cast<std::size_t>(x.pixels) * static_cast<std::size_t>(y.pixels)) return {};
  std::map<long, Crossing> crossings;  // by the number of the edge
  const MapField field(x, y, values);
  constexpr int corner[5][2]{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  for (int row = -1; row < y.pixels; ++row)
    for (int column = -1; column < x.pixels; ++column) {
      std::vector<long> edges;
      for (int edge = 0; edge < 4; ++edge) {
        const int c0 = column + corner[edge][0], r0 = row + corner[edge][1];
        const int c1 = column + corner[edge + 1][0], r1 = row + corner[edge + 1][1];
        const double a = field.value(c0, r0), b = field.value(c1, r1);
        if (!std::isfinite(a) || !std::isfinite(b) || (a < 0.0) == (b < 0.0)) continue;
        const MapPoint from = field.place(c0, r0), to = field.place(c1, r1);
        const double s = a / (a - b);
        edges.push_back(2L * ((std::min(r0, r1) + 1L) * (x.pixels + 2L) + std::min(c0, c1) + 1L) + (c0 == c1));
        crossings[edges.back()].at = {from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])};
      }
      for (std::size_t k = 0; k + 1 < edges.size(); k += 2) {
        crossings[edges[k]].next.push_back(edges[k + 1]);
        crossings[edges[k + 1]].next.push_back(edges[k]);
      }
    }
  std::vector<MapLine> lines;
  for (const std::size_t ways : {1u, 2u})  // those with ends first, from an end; what is left is closed
    for (const auto& [edge, crossing] : crossings)
      if (crossing.next.size() == ways) lines.push_back(followed(crossings, edge));
  return lines;
}

std::string part_words(double part) {
  const double percent = 100.0 * part;
  if (percent > 0.0 && percent < 0.05) return "less than 0.1 %";
  return percent > 99.95 && percent < 100.0 ? "more than 99.9 %" : fmt::format("{:.1f} %", percent);
}

AxisWords axis_words(const Study& study, const SliceAxis& axis) {
  if (axis.angle()) {
    const std::string label = axis_label(axis.key);
    return {label.substr(0, label.find(" (rad)")) + " / π", 1.0 / pi};
  }
  const auto unit = study::unit_of(study, axis.key);
  if (!unit) return {axis_label(axis.key), 1.0};
  const double largest = std::max(std::fabs(axis.low), std::fabs(axis.high));
  const EngineeringUnit e = engineering_unit(largest * unit->scale, unit->dimension);
  return {fmt::format("{}, {}", key_words(axis.key), e.name), unit->scale / e.si, false, e.name};
}

PlaneColumns::PlaneColumns(const Study& study, const SliceAxis& x, const SliceAxis& y) {
  const AxisWords along_x = axis_words(study, x), along_y = axis_words(study, y);
  titles = csv_title(x.key, along_x.unit) + "," + csv_title(y.key, along_y.unit);
  x_factor = along_x.factor;
  y_factor = along_y.factor;
}

std::string PlaneColumns::values(double x, double y) const { return fmt::format("{},{}", x * x_factor, y * y_factor); }

PlanePicture::PlanePicture(const std::string& described, const Study& study, const SliceAxis& x, const SliceAxis& y)
    : svg(drawing_width, below_plane, described),
      axes(svg, plane_top_left, plane_bottom_right, {x.low, x.high}, {y.low, y.high}, axis_words(study, x),
           axis_words(study, y)) {}

void PlanePicture::fill(int columns, int rows, const std::function<std::string(int column, int row)>& colour) {
  Raster raster{static_cast<std::size_t>(columns), static_cast<std::size_t>(rows), {}, {}};
  for (int row = rows - 1; row >= 0; --row)
    for (int column = 0; column < columns; ++column) raster.add(colour(column, row));
  svg.image(plane_top_left, plane_side, plane_side, raster);
}

void PlanePicture::draw(const std::vector<Border>& borders) {
  for (const bool light : {true, false})  // no line is hidden by what is below another
    for (const Border& b : borders)
      for (const MapLine& line : b.lines) {
        std::vector<SvgPoint> way;
        for (const MapPoint& p : line) way.push_back(axes.at(p[0], p[1]));
        svg.path(way, light ? SvgPen{"#ffffff", "", b.pen.width + 2.0} : b.pen);
      }
  for (const Border& b : borders)
    if (!b.lines.empty()) legend.push_back({b.pen, b.meaning, LegendEntry::Mark::line});
}

std::string PlanePicture::str() {
  draw_legend(svg, legend);
  legend.clear();
  return svg.str();
}

}  // namespace equipoise
