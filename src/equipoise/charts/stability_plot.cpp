// The script: the image, the boundaries, the legend.
#include "equipoise/charts/stability_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

#include "equipoise/answers/quantities.hpp"
#include "equipoise/charts/shown_axis.hpp"
#include "equipoise/charts/stability_report.hpp"
#include "equipoise/drawing/plot_parts.hpp"
#include "equipoise/echo/given_value.hpp"
#include "equipoise/plots/zero_line.hpp"
#include "equipoise/text/engineering.hpp"
#include "equipoise/words/plots.hpp"
#include "equipoise/words/stability.hpp"

namespace equipoise {

namespace {

constexpr int most_drawn_points = 1600;  // along one side: more than the canvas shows

// Every so many-th row and column.
StabilityPlane drawn_part(const StabilityPlane& plane) {
  const int longest = std::max(plane.x.pixels, plane.y.pixels);
  const int every =
      std::min((longest + most_drawn_points - 1) / most_drawn_points, std::min(plane.x.pixels, plane.y.pixels));
  if (every <= 1) return plane;
  StabilityPlane part = plane;
  part.x = thinned(plane.x, every);
  part.y = thinned(plane.y, every);
  part.points.clear();
  for (int row = first_of(every); row < plane.y.pixels; row += every)
    for (int column = first_of(every); column < plane.x.pixels; column += every)
      part.points.push_back(plane.points[plane.at(column, row)]);
  return part;
}

// Packed red, green and blue, lighter for slow rates.
int shaded(const char* colour, double share) {
  const int packed = static_cast<int>(std::strtol(colour + 1, nullptr, 16));
  const double strength = 0.25 + 0.75 * std::clamp(share, 0.0, 1.0);
  int result = 0;
  for (const int shift : {16, 8, 0}) {
    const double full = packed >> shift & 255;
    result |= static_cast<int>(std::lround(255.0 - strength * (255.0 - full))) << shift;
  }
  return result;
}

const char* colour_of_kind(BalanceKind kind) {
  switch (kind) {
    case BalanceKind::stable:
      return dark_colour;
    case BalanceKind::unstable:
      return light_colour;
    case BalanceKind::none:
      return "#C8C8C8";
    case BalanceKind::marginal:
      return "#F4F0D0";
    case BalanceKind::unknown:
      return "#8C8C8C";
    default:
      return "#FFFFFF";
  }
}

std::string stability_image(const StabilityPlane& plane) {
  std::array<double, 2> fastest{0.0, 0.0};  // of decay, of growth
  for (const BalancePoint& p : plane.points)
    if (std::isfinite(p.growth)) {
      double& most = fastest[p.growth > 0.0 ? 1 : 0];
      most = std::max(most, std::fabs(p.growth));
    }
  std::string text = "$balance << EOD\n";
  for (std::size_t k = 0; k < plane.points.size(); ++k) {
    const BalancePoint& p = plane.points[k];
    const bool has_rate = p.kind == BalanceKind::stable || p.kind == BalanceKind::unstable;
    const double most = fastest[p.growth > 0.0 ? 1 : 0];
    const double share = has_rate && most > 0.0 ? std::sqrt(std::fabs(p.growth) / most) : 1.0;
    const bool last = (k + 1) % static_cast<std::size_t>(plane.x.pixels) == 0;
    text += fmt::format("{}{}", shaded(colour_of_kind(p.kind), share), last ? "\n" : " ");
  }
  return text + "EOD\n";
}

using Pieces = std::vector<std::array<MapPoint, 2>>;

std::string pieces_block(const char* name, const Pieces& pieces, double x_factor, double y_factor) {
  std::string text = std::string(name) + " << EOD\n";
  for (const auto& [a, b] : pieces)
    text += fmt::format("{:.8g} {:.8g}\n{:.8g} {:.8g}\n\n", a[0] * x_factor, a[1] * y_factor, b[0] * x_factor,
                        b[1] * y_factor);
  return text + "EOD\n";
}

// Whether an eigenvalue turns at the point next to this place.
bool turns_at(const StabilityPlane& plane, const MapPoint& place) {
  const auto nearest = [](const SliceAxis& axis, double value) {
    return std::clamp(static_cast<int>((value - axis.low) / axis.step()), 0, axis.pixels - 1);
  };
  return plane.points[plane.at(nearest(plane.x, place[0]), nearest(plane.y, place[1]))].swings();
}

}  // namespace

ShownAxis shown_axis(const Study& study, const SliceAxis& axis) {
  const auto unit = study::unit_of(study, axis.key);
  if (!unit) return {axis_label(axis.key), 1.0};
  const EngineeringUnit e = engineering_unit(axis.high * unit->scale, unit->dimension);
  return {fmt::format("{}, {}", key_words(axis.key), e.name), unit->scale / e.si, e.name};
}

std::string stability_plot_script(const StabilityPlane& whole, const std::string& title, const std::string& path) {
  const StabilityPlane plane = drawn_part(whole);
  const ShownAxis x = shown_axis(plane.study, plane.x), y = shown_axis(plane.study, plane.y);
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
  Pieces hopf, zero;
  for (const auto& piece : zero_line(plane.x, plane.y, growth))
    (turns_at(plane, piece[0]) ? hopf : zero).push_back(piece);
  std::string script = canvas(path, 1600, 1000) + stability_image(plane);
  std::string items = fmt::format(
      "$balance matrix using ({:.10g}+$1*{:.10g}):({:.10g}+$2*{:.10g}):(int($3)/65536):(int($3)/256%256):(int($3)%256) "
      "with rgbimage notitle",
      plane.x.centre(0) * x.factor, plane.x.step() * x.factor, plane.y.centre(0) * y.factor, plane.y.step() * y.factor);
  const auto add = [&](const std::string& item) { items += ", \\\n  " + item; };
  for (const BalanceKind kind : {BalanceKind::stable, BalanceKind::unstable, BalanceKind::none, BalanceKind::marginal,
                                 BalanceKind::unknown, BalanceKind::not_computed}) {
    const std::size_t count = whole.count(kind);
    if (count == 0) continue;
    const double percent = 100.0 * static_cast<double>(count) / static_cast<double>(whole.points.size());
    const std::string part = percent < 0.05 ? "< 0.1 %" : fmt::format("{:.1f} %", percent);
    add(
        fmt::format("keyentry with filledcurves fillcolor rgb '{}' fillstyle solid 1.0 border linecolor rgb '#444444' "
                    "title {}",
                    colour_of_kind(kind),
                    quoted(kind == BalanceKind::not_computed
                               ? fmt::format(words::stability::legend_not_computed, part)
                               : fmt::format(words::stability::legend, balance_words(kind), part))));
  }
  const auto add_border = [&](const char* name, const Pieces& pieces, const char* dash, const char* meaning) {
    if (pieces.empty()) return;
    script += pieces_block(name, pieces, x.factor, y.factor);
    add(fmt::format("{} with lines linecolor rgb '#FFFFFF' linewidth 4.5 notitle", name));
    add(fmt::format("{} with lines linecolor rgb '#000000' linewidth 2 {} title {}", name, dash, quoted(meaning)));
  };
  add_border("$hopf", hopf, "", words::stability::line_hopf);
  add_border("$zero", zero, "dashtype (3,4)", words::stability::line_zero);
  add_border("$exists", zero_line(plane.x, plane.y, exists), "dashtype (10,7)", words::stability::line_existence);
  if (plane.own && !plane.own->boundaries.empty()) {
    script += fmt::format("$own << EOD\n{:.10g} {:.10g}\nEOD\n", plane.own->x * x.factor, plane.own->y * y.factor);
    add("$own with points pointtype 7 pointsize 2.6 linecolor rgb '#FFFFFF' notitle");
    add(fmt::format("$own with points pointtype 6 pointsize 2.2 linewidth 3 linecolor rgb '#000000' title {}",
                    quoted(words::stability::the_study)));
  }
  const std::string details = parameters_text(plane.study, {plane.x.key, plane.y.key});
  script += fmt::format("set title {}.\"\\n\".{} offset 0,0.3\n", quoted(title),
                        quoted(details + "; " + words::stability::darker_is_faster +
                               (plane.one_of_many() ? words::stability::of_spread_balls : "") +
                               (plane.complete ? "" : words::plots::partial_early)));
  script += fmt::format("set xlabel {}\nset ylabel {} offset -0.6,0\n", quoted(x.label), quoted(y.label));
  script += fmt::format("set xrange [{:.10g}:{:.10g}]\nset yrange [{:.10g}:{:.10g}]\n", plane.x.low * x.factor,
                        plane.x.high * x.factor, plane.y.low * y.factor, plane.y.high * y.factor);
  script +=
      "set border linecolor rgb '#444444'\nset tics nomirror out textcolor rgb '#222222'\n"
      "set key outside right top vertical Left reverse samplen 2.2 spacing 1.3 width 1\n";
  script += "plot " + items + "\n";
  return script;
}

}  // namespace equipoise
