// Boxes, curves in pieces of one kind, points, letters of regions, the legend.
#include "equipoise/extras/charts/chart_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "equipoise/extras/charts/plane_plot.hpp"
#include "equipoise/extras/charts/stability_report.hpp"
#include "equipoise/report/drawing/raster.hpp"
#include "equipoise/report/drawing/svg.hpp"
#include "equipoise/report/plots/plane_frame.hpp"

namespace equipoise {

namespace {

// How pieces of curves of a kind are drawn; those of Hopf curves by what is lost there.
struct StrokeStyle {
  CurveKind kind;
  char loss;  // see loss_at()
  SvgPen pen;
  const char* words;
};
const std::array<StrokeStyle, 11> strokes{{
    {CurveKind::hopf, 's', {"#000000", "", 2.0}, "balance is lost softly"},
    {CurveKind::hopf, 'a', {"#C00000", "", 2.0, 1.0, true, "7 4"}, "balance is lost abruptly"},
    {CurveKind::hopf, ' ', {"#000000", "", 0.8}, "a swing begins"},
    {CurveKind::zero, ' ', {"#000000", "", 1.1, 1.0, true, "2 3"}, "a real eigenvalue crosses"},
    {CurveKind::existence, ' ', {"#444444", "", 1.3, 1.0, true, "7 3 2 3"}, "balance ends"},
    {CurveKind::fold, ' ', {"#6A3D9A", "", 1.5}, "two locked states merge"},
    {CurveKind::pitchfork, ' ', {"#6A3D9A", "", 1.5, 1.0, true, "2 3"}, "balls of a locked state part"},
    {CurveKind::hopf, 'l', {"#1B7837", "", 1.5, 1.0, true, "6 3"}, "a locked state begins to swing"},
    {CurveKind::cycle_fold, ' ', {"#E66101", "", 1.5}, "two cycles merge"},
    {CurveKind::cycle_flip, ' ', {"#E66101", "", 1.5, 1.0, true, "2 3"}, "a cycle's period doubles"},
    {CurveKind::cycle_torus, ' ', {"#E66101", "", 1.5, 1.0, true, "7 3"}, "a cycle becomes a torus"},
}};

// Of a Hopf curve: balance softly or abruptly, a locked state, or nothing: it was unstable before.
char loss_at(const ChartCurve& curve, const CurvePoint& p) {
  if (curve.kind != CurveKind::hopf) return ' ';
  if (curve.of != of_balance) return 'l';
  return p.others > 0 || std::isnan(p.lyapunov) ? ' ' : p.lyapunov < 0.0 ? 's' : 'a';
}

struct BoxLook {
  ProvedKind kind;
  const char* colour;
  BalanceKind balance;
};
constexpr std::array<BoxLook, 3> box_looks{{{ProvedKind::stable, "#8CC3E6", BalanceKind::stable},
                                            {ProvedKind::unstable, "#F3CF8E", BalanceKind::unstable},
                                            {ProvedKind::none, "#C8C8C8", BalanceKind::none}}};

// The pieces of all curves that are drawn in one way.
Border border_of(const BifurcationChart& chart, const StrokeStyle& style) {
  Border border{{}, style.pen, style.words};
  for (const ChartCurve& curve : chart.curves)
    for (std::size_t k = 1, last = 0; curve.kind == style.kind && k < curve.points.size(); ++k) {
      const CurvePoint &a = curve.points[k - 1], &b = curve.points[k];
      if (loss_at(curve, std::isnan(a.lyapunov) ? b : a) != style.loss) continue;
      if (last != k - 1 || last == 0) border.lines.push_back({{a.x, a.y}});
      border.lines.back().push_back({b.x, b.y});
      last = k;
    }
  return border;
}

const BoxLook* look_of(ProvedKind kind) {
  const auto at = std::find_if(box_looks.begin(), box_looks.end(), [=](const BoxLook& l) { return l.kind == kind; });
  return at == box_looks.end() ? nullptr : &*at;
}

// Boxes are many and small. Of those at an edge of a pixel the one at its centre counts.
Raster raster_of(const BifurcationChart& chart) {
  constexpr int side = most_drawn_pixels;
  const SliceAxis x{"", chart.plane.x.low, chart.plane.x.high, side},
      y{"", chart.plane.y.low, chart.plane.y.high, side};
  std::vector<ProvedKind> kinds(static_cast<std::size_t>(side) * side, ProvedKind::open);
  const auto first_from = [](const SliceAxis& axis, double value) {
    return static_cast<int>(std::clamp(std::ceil((value - axis.low) / axis.step() - 0.5), 0.0, 1.0 * side));
  };
  for (const ProofBox& b : chart.boxes)
    for (int row = first_from(y, b.y[0]); row < first_from(y, b.y[1]); ++row)
      std::fill(kinds.begin() + (side - 1 - row) * side + first_from(x, b.x[0]),
                kinds.begin() + (side - 1 - row) * side + first_from(x, b.x[1]), b.kind);
  Raster raster{side, side, {}, {}};
  for (const ProvedKind kind : kinds) raster.add(look_of(kind) ? look_of(kind)->colour : "#FFFFFF");
  return raster;
}

void draw_boxes(Svg& svg, const BifurcationChart& chart, std::vector<LegendEntry>& legend) {
  if (chart.boxes.empty()) return;
  svg.image(plane_top_left, plane_side, plane_side, png_bytes(raster_of(chart)));  // over the grid
  for (const BoxLook& look : box_looks)
    if (chart.proved(look.kind) > 0.0)
      legend.push_back({{"", look.colour}, fmt::format("proved: {}", balance_words(look.balance))});
  if (chart.proved(ProvedKind::open) > 0.0) legend.push_back({{"", "#ffffff"}, "not decided"});
}

void draw_specials(Svg& svg, const SvgAxes& axes, const BifurcationChart& chart, std::vector<LegendEntry>& legend) {
  const SvgPen ring{"#000000", "#ffffff", 1.5};
  for (const SpecialPoint& p : chart.specials) svg.circle(axes.at(p.x, p.y), 3.5, ring);
  if (!chart.specials.empty()) legend.push_back({ring, "where curves change their kind", LegendEntry::Mark::ring});
}

// What is at rest and stable: "balance, balls together".
std::string stable_words(const BifurcationChart& chart, const ChartRegion& region) {
  std::vector<std::string> stable;
  if (region.balance == BalanceKind::stable) stable.push_back(of_balance);
  for (std::size_t k = 0; k < region.locked.size(); ++k)
    if (region.locked[k].stable > 0) stable.push_back(chart.locked[k]);
  return stable.empty() ? "nothing" : fmt::format("{}", fmt::join(stable, ", "));
}

void draw_regions(Svg& svg, const SvgAxes& axes, const BifurcationChart& chart, std::vector<LegendEntry>& letters) {
  const std::size_t regions = told_regions(chart);
  for (std::size_t k = 0; regions > 1 && k < regions; ++k) {
    const ChartRegion& r = chart.regions[k];
    const SvgPoint at = axes.at(r.x, r.y);
    svg.circle(at, 7.5, {"", "#ffffff", 1.0, 0.75});
    svg.text({at.x, at.y + 4.0}, region_letter(k), SvgAnchor::middle, "#1a1a1a", 12.0);
    letters.push_back({{}, region_letter(k) + ": " + stable_words(chart, r), LegendEntry::Mark::none});
  }
}

}  // namespace

std::string chart_plot(const BifurcationChart& chart, const std::string& title) {
  const StabilityPlane& plane = chart.plane;
  Svg svg(drawing_width, below_plane, "Curves on which balance and locked states change");
  const SvgAxes axes = plane_axes(svg, plane);
  std::vector<LegendEntry> legend, letters;
  draw_boxes(svg, chart, legend);
  std::vector<Border> borders;
  for (const StrokeStyle& style : strokes) borders.push_back(border_of(chart, style));
  draw_borders(svg, axes, borders);
  add_to_legend(legend, borders);
  draw_specials(svg, axes, chart, legend);
  draw_regions(svg, axes, chart, letters);
  draw_legend(svg, legend);
  if (!letters.empty()) draw_legend(svg, {{{}, "at rest and stable:", LegendEntry::Mark::none}});
  draw_legend(svg, letters);
  return plane_plot(svg, plane, title, chart.complete, "");
}

}  // namespace equipoise
