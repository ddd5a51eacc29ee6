// Pixels as a picture in axes, limits of balance, legend.
#include "equipoise/plots/map_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/drawing/chart_svg.hpp"
#include "equipoise/drawing/plot_parts.hpp"
#include "equipoise/drawing/raster.hpp"
#include "equipoise/drawing/svg.hpp"
#include "equipoise/answers/quantities.hpp"
#include "equipoise/plots/zero_line.hpp"
#include "equipoise/echo/given_value.hpp"
#include "equipoise/text/text.hpp"
#include "equipoise/words/plots.hpp"

namespace equipoise {

namespace {

// Angles of balls in parts of a turn, quantities in the unit that suits the largest value, others as in pictures.
AxisWords words_for(const Study& study, const SliceAxis& axis) {
  if (axis.angle()) {
    const std::string label = axis_label(axis.key);
    return {label.substr(0, label.find(" (rad)")) + " / π", 1.0 / pi};
  }
  const double largest = std::max(std::fabs(axis.low), std::fabs(axis.high));
  if (const auto unit = study.scales ? study::unit_of(study, axis.key) : std::nullopt)
    return PageQuantities(study).axis(key_words(axis.key), largest, unit->dimension);
  return {axis_label(axis.key), 1.0};
}

// Pixels from the top, by outcome; pixels not computed are white.
Raster raster_of(const BasinSlice& map) {
  Raster raster{static_cast<std::size_t>(map.x.pixels), static_cast<std::size_t>(map.y.pixels), {}, {}};
  std::map<short, std::uint8_t> places;
  for (int row = map.y.pixels - 1; row >= 0; --row)
    for (int column = 0; column < map.x.pixels; ++column) {
      const short code = map.code[map.at(column, row)];
      const auto [at, is_new] = places.try_emplace(code, static_cast<std::uint8_t>(places.size()));
      if (is_new) raster.palette.emplace_back(code == not_computed_code ? "#FFFFFF" : colour_of(code));
      raster.squares.push_back(at->second);
    }
  return raster;
}

void draw_border(Svg& svg, const SvgAxes& axes, const std::vector<std::array<MapPoint, 2>>& pieces, bool dashed) {
  for (const SvgPen& pen : {SvgPen{"#ffffff", "", 3.4}, SvgPen{"#000000", "", 1.5, 1.0, dashed}})
    for (const auto& [a, b] : pieces) svg.line(axes.at(a[0], a[1]), axes.at(b[0], b[1]), pen);
}

}  // namespace

std::string slice_axis_words(const Study& study, const SliceAxis& axis) {
  const AxisWords words = words_for(study, axis);
  return fmt::format(words::plots::axis_from_to, words.label, axis.low * words.factor, axis.high * words.factor);
}

std::string map_svg(const BasinSlice& map) {
  constexpr double frame = 358.0;  // square: most maps are
  constexpr SvgPoint top_left{58.0, 10.0}, bottom_right{58.0 + frame, 10.0 + frame};
  constexpr double below = bottom_right.y + 42.0;
  std::vector<LegendEntry> entries;
  for (const OutcomeShare& c : map.codes)
    if (c.share.count > 0)
      entries.push_back({colour_of(c.id), fmt::format("{}, {}", legend_of(c), percent(c.share.share, 1))});
  Svg svg(drawing_width, below + legend_height(entries), words::plots::outcome_at_points);
  const SvgAxes axes(svg, top_left, bottom_right, {map.x.low, map.x.high}, {map.y.low, map.y.high},
                     words_for(map.study, map.x), words_for(map.study, map.y));
  svg.image(top_left, frame, frame, png_bytes(raster_of(map)));  // over the grid
  draw_border(svg, axes, zero_line(map, map.balance_margin), true);
  draw_border(svg, axes, zero_line(map, map.balance_growth), false);
  draw_legend(svg, below, entries);
  return svg.str();
}

}  // namespace equipoise
