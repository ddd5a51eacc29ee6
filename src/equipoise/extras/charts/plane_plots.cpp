// Drawings: an image, lines on it, the legend.
#include "equipoise/extras/charts/plane_reports.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/report/plots/plane_frame.hpp"

namespace equipoise {

namespace {

DrawingRow row_with(const std::string& drawing, const StabilityPlane& plane, bool complete, const char* caption) {
  DrawingRow row{{{"", drawing}}, caption, DrawingSize::wide};
  row.details = parameters_text(plane.study, {plane.x.key, plane.y.key}) +
                (plane.one_of_many() ? "; balls spread evenly, one balanced state of many" : "") +
                (complete ? "" : " (PARTIAL: stopped early)");
  return row;
}

// Every n-th row and column.
StabilityPlane drawn_part(const StabilityPlane& plane) {
  const int longest = std::max(plane.x.pixels, plane.y.pixels);
  const int every =
      std::min((longest + most_drawn_pixels - 1) / most_drawn_pixels, std::min(plane.x.pixels, plane.y.pixels));
  if (every <= 1) return plane;
  StabilityPlane part{plane, plane.study, thinned(plane.x, every), thinned(plane.y, every),
                      {},    plane.own,   plane.complete};
  for (int row = first_of(every); row < plane.y.pixels; row += every)
    for (int column = first_of(every); column < plane.x.pixels; column += every)
      part.points.push_back(plane.points[plane.at(column, row)]);
  return part;
}

const char* colour_of_kind(BalanceKind kind) {
  constexpr std::array colours{"#C8C8C8", dark_colour, light_colour, "#F4F0D0", "#8C8C8C"};
  const auto place = static_cast<std::size_t>(kind);
  return place < colours.size() ? colours[place] : "#FFFFFF";
}

// Lighter for slow rates.
class RateColours {
 public:
  explicit RateColours(const StabilityPlane& plane) {
    for (const BalancePoint& p : plane.points)
      if (std::isfinite(p.growth)) {
        double& most = fastest_[p.growth > 0.0 ? 1 : 0];
        most = std::max(most, std::fabs(p.growth));
      }
    for (std::size_t k = 0; k < shades; ++k)
      for (const BalanceKind kind : {BalanceKind::stable, BalanceKind::unstable}) {
        constexpr double lightest = 0.25;
        const double strength = lightest + (1.0 - lightest) * static_cast<double>(k) / (shades - 1);
        colours_[kind == BalanceKind::unstable ? 1 : 0][k] = mixed_colour("#ffffff", colour_of_kind(kind), strength);
      }
  }

  std::string of(const BalancePoint& p) const {
    if (!std::isfinite(p.growth) || (p.kind != BalanceKind::stable && p.kind != BalanceKind::unstable))
      return colour_of_kind(p.kind);
    const std::size_t side = p.growth > 0.0 ? 1 : 0;
    const double share = fastest_[side] > 0.0 ? std::sqrt(std::fabs(p.growth) / fastest_[side]) : 1.0;
    return colours_[side][static_cast<std::size_t>(std::lround(share * (shades - 1)))];
  }

 private:
  static constexpr std::size_t shades = 60;
  std::array<double, 2> fastest_{0.0, 0.0};  // of decay, of growth
  std::array<std::array<std::string, shades>, 2> colours_;
};

// Whether an eigenvalue turns at the point next to this place.
bool turns_at(const StabilityPlane& plane, const MapPoint& place) {
  const auto nearest = [](const SliceAxis& axis, double value) {
    return std::clamp(static_cast<int>((value - axis.low) / axis.step()), 0, axis.pixels - 1);
  };
  return plane.points[plane.at(nearest(plane.x, place[0]), nearest(plane.y, place[1]))].swings();
}

// Where a pair crosses, and where a real eigenvalue does.
std::array<std::vector<MapLine>, 2> crossings(const StabilityPlane& plane, const std::vector<float>& growth) {
  std::array<std::vector<MapLine>, 2> parts;
  for (const MapLine& line : zero_line(plane.x, plane.y, growth)) {
    int last = -1;
    for (const MapPoint& at : line) {
      const int part = turns_at(plane, at) ? 0 : 1;
      auto& lines = parts[static_cast<std::size_t>(part)];
      if (part != last)
        lines.push_back(last < 0 ? MapLine() : MapLine{parts[static_cast<std::size_t>(last)].back().back()});
      lines.back().push_back(at);
      last = part;
    }
  }
  return parts;
}

std::vector<Border> borders_of(const StabilityPlane& plane) {
  std::vector<float> growth, exists;
  for (const BalancePoint& p : plane.points) {
    growth.push_back(static_cast<float>(p.growth));
    exists.push_back(p.kind == BalanceKind::none ? -1.0f : 1.0f);
  }
  // Where the masses alone decide about existence, their margin gives a smoother line.
  const bool by_mass = std::all_of(plane.points.begin(), plane.points.end(), [](const BalancePoint& p) {
    return std::isfinite(p.margin) && (p.margin < 0.0) == (p.kind == BalanceKind::none);
  });
  if (by_mass)
    for (std::size_t k = 0; k < exists.size(); ++k) exists[k] = static_cast<float>(plane.points[k].margin);
  auto [hopf, zero] = crossings(plane, growth);
  return {{std::move(hopf), {"#000000", "", 1.5}, "a pair crosses (Hopf)"},
          {std::move(zero), {"#000000", "", 1.5, 1.0, true, "2 3"}, "a real eigenvalue crosses"},
          {zero_line(plane.x, plane.y, exists), {"#000000", "", 1.5, 1.0, true, "6 4"}, "balance ends"}};
}

// What balance is, with the part of the plane.
std::string legend_words(BalanceKind kind, double part) {
  return kind == BalanceKind::not_computed ? fmt::format("not computed, {}", part_words(part))
                                           : fmt::format("balance {}, {}", balance_words(kind), part_words(part));
}

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

// Of a box.
const char* colour_of_proof(BalanceKind kind) {
  return kind == BalanceKind::stable     ? "#8CC3E6"
         : kind == BalanceKind::unstable ? "#F3CF8E"
         : kind == BalanceKind::none     ? "#C8C8C8"
                                         : "#FFFFFF";
}

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

// Boxes are many and small. For those at an edge of a pixel the one at its centre counts.
void draw_boxes(PlanePicture& picture, const BifurcationChart& chart) {
  if (chart.boxes.empty()) return;
  constexpr int side = most_drawn_pixels;
  const SliceAxis x{"", chart.plane.x.low, chart.plane.x.high, side},
      y{"", chart.plane.y.low, chart.plane.y.high, side};
  std::vector<BalanceKind> kinds(static_cast<std::size_t>(side) * side, BalanceKind::open);
  const auto first_from = [](const SliceAxis& axis, double value) {
    return static_cast<int>(std::clamp(std::ceil((value - axis.low) / axis.step() - 0.5), 0.0, 1.0 * side));
  };
  for (const ProofBox& b : chart.boxes)
    for (int row = first_from(y, b.y[0]); row < first_from(y, b.y[1]); ++row)
      std::fill(kinds.begin() + row * side + first_from(x, b.x[0]), kinds.begin() + row * side + first_from(x, b.x[1]),
                b.kind);
  picture.fill(side, side, [&](int column, int row) {
    return colour_of_proof(kinds[static_cast<std::size_t>(row * side + column)]);
  });
  for (const BalanceKind kind : {BalanceKind::stable, BalanceKind::unstable, BalanceKind::none})
    if (chart.proved(kind) > 0.0)
      picture.legend.push_back({{"", colour_of_proof(kind)}, fmt::format("proved: {}", balance_words(kind))});
  if (chart.proved(BalanceKind::open) > 0.0) picture.legend.push_back({{"", "#ffffff"}, "not decided"});
}

void draw_specials(PlanePicture& picture, const BifurcationChart& chart) {
  const SvgPen ring{"#000000", "#ffffff", 1.5};
  for (const SpecialPoint& p : chart.specials) picture.svg.circle(picture.axes.at(p.x, p.y), 3.5, ring);
  if (!chart.specials.empty())
    picture.legend.push_back({ring, "where curves change their kind", LegendEntry::Mark::ring});
}

// What is at rest and stable: "balance, balls together".
std::string stable_words(const BifurcationChart& chart, const ChartRegion& region) {
  std::vector<std::string> stable;
  if (region.balance == BalanceKind::stable) stable.push_back(of_balance);
  for (std::size_t k = 0; k < region.locked.size(); ++k)
    if (region.locked[k].stable > 0) stable.push_back(chart.locked[k]);
  return stable.empty() ? "nothing" : fmt::format("{}", fmt::join(stable, ", "));
}

// The letters of regions in their places; returns what they stand for.
std::vector<LegendEntry> draw_regions(PlanePicture& picture, const BifurcationChart& chart) {
  std::vector<LegendEntry> letters;
  const std::size_t regions = told_regions(chart);
  for (std::size_t k = 0; regions > 1 && k < regions; ++k) {
    const ChartRegion& r = chart.regions[k];
    const SvgPoint at = picture.axes.at(r.x, r.y);
    picture.svg.circle(at, 7.5, {"", "#ffffff", 1.0, 0.75});
    picture.svg.text({at.x, at.y + 4.0}, region_letter(k), SvgAnchor::middle, "#1a1a1a", 12.0);
    letters.push_back({{}, region_letter(k) + ": " + stable_words(chart, r), LegendEntry::Mark::none});
  }
  return letters;
}

}  // namespace

DrawingRow stability_drawing(const StabilityPlane& whole) {
  const StabilityPlane plane = drawn_part(whole);
  PlanePicture picture("What balance does over the plane", plane.study, plane.x, plane.y);
  const RateColours colours(plane);
  picture.fill(plane.x.pixels, plane.y.pixels,
               [&](int column, int row) { return colours.of(plane.points[plane.at(column, row)]); });
  for (const BalanceKind kind : {BalanceKind::stable, BalanceKind::unstable, BalanceKind::none, BalanceKind::marginal,
                                 BalanceKind::unknown, BalanceKind::not_computed})
    if (const std::size_t count = whole.count(kind); count > 0)
      picture.legend.push_back(
          {{"", colour_of_kind(kind)},
           legend_words(kind, static_cast<double>(count) / static_cast<double>(whole.points.size()))});
  picture.draw(borders_of(plane));
  if (plane.own && !plane.own->boundaries.empty()) {
    const SvgPen ring{"#000000", "#ffffff", 2.0};
    picture.svg.circle(picture.axes.at(plane.own->x, plane.own->y), 5.0, ring);
    picture.legend.push_back({ring, "the study", LegendEntry::Mark::ring});
  }
  return row_with(picture.str(), whole, whole.complete, "The darker, the faster deviations die out or grow.");
}

DrawingRow chart_drawing(const BifurcationChart& chart) {
  const StabilityPlane& plane = chart.plane;
  PlanePicture picture("Curves on which balance and locked states change", plane.study, plane.x, plane.y);
  draw_boxes(picture, chart);
  std::vector<Border> borders;
  for (const StrokeStyle& style : strokes) borders.push_back(border_of(chart, style));
  picture.draw(borders);
  draw_specials(picture, chart);
  const std::vector<LegendEntry> letters = draw_regions(picture, chart);
  draw_legend(picture.svg, std::exchange(picture.legend, letters));
  if (!letters.empty()) draw_legend(picture.svg, {{{}, "at rest and stable:", LegendEntry::Mark::none}});
  return row_with(picture.str(), plane, chart.complete, "");
}

}  // namespace equipoise
