// Borders over a plane.
#include "equipoise/report/plots/plane_frame.hpp"

#include <fmt/format.h>

namespace equipoise {

std::string part_words(double part) {
  return part > 0.0 && part < 0.0005 ? "< 0.1 %" : fmt::format("{:.1f} %", 100.0 * part);
}

void add_to_legend(std::vector<LegendEntry>& legend, const std::vector<Border>& borders) {
  for (const Border& b : borders)
    if (!b.lines.empty()) legend.push_back({b.pen, b.meaning, LegendEntry::Mark::line});
}

void draw_borders(Svg& svg, const SvgAxes& axes, const std::vector<Border>& borders) {
  for (const bool below : {true, false})  // no line is hidden by what is below another
    for (const Border& b : borders)
      for (const MapLine& line : b.lines) {
        std::vector<SvgPoint> way;
        for (const MapPoint& p : line) way.push_back(axes.at(p[0], p[1]));
        svg.path(way, below ? SvgPen{"#ffffff", "", b.pen.width + 2.0} : b.pen);
      }
}

}  // namespace equipoise
