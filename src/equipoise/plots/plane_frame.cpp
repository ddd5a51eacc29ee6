// Borders over a plane.
#include "equipoise/plots/plane_frame.hpp"

namespace equipoise {

void add_to_legend(std::vector<LegendEntry>& legend, const std::vector<Border>& borders) {
  for (const Border& b : borders)
    if (!b.lines.empty()) legend.push_back({b.pen, b.meaning, LegendEntry::Mark::line});
}

void draw_borders(Svg& svg, const SvgAxes& axes, const std::vector<Border>& borders) {
  for (const Border& b : borders)
    for (const SvgPen& pen : {SvgPen{"#ffffff", "", b.pen.width + 2.0}, b.pen})
      for (const MapLine& line : b.lines) {
        std::vector<SvgPoint> way;
        for (const MapPoint& p : line) way.push_back(axes.at(p[0], p[1]));
        svg.path(way, pen);
      }
}

}  // namespace equipoise
