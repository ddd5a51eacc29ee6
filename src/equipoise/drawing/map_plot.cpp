// The script: the image, the borders of balance, the legend.
#include "equipoise/drawing/map_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/drawing/plot_parts.hpp"

namespace equipoise {

namespace {

using Point = std::array<double, 2>;

// Along a side: more than the canvas shows.
constexpr int most_drawn_pixels = 1600;

// A field known at the pixels' centres, and continued from there in a straight line to the map's edges.
class Field {
 public:
  Field(const PlaneMap& map, const std::vector<float>& values) : map_(map), values_(values) {}

  double value(int column, int row) const {
    const Weights a = weights(column, map_.x.pixels), b = weights(row, map_.y.pixels);
    double sum = 0.0;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        if (a.share[i] * b.share[j] != 0.0) sum += a.share[i] * b.share[j] * values_[map_.at(a.pixel[i], b.pixel[j])];
    // What is only extrapolated shows no change of sign.
    const double nearest = values_[map_.at(a.pixel[0], b.pixel[0])];
    return (sum < 0.0) == (nearest < 0.0) ? sum : nearest;
  }
  Point place(int column, int row) const { return {along(map_.x, column), along(map_.y, row)}; }

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
  static double along(const MapAxis& axis, int k) { return std::clamp(axis.centre(k), axis.low, axis.high); }
  const PlaneMap& map_;
  const std::vector<float>& values_;
};

// Ends of the line pieces on which a field is zero, by linear interpolation along the edges of every cell between four
// centres; pieces beside undefined values are left out.
std::vector<std::array<Point, 2>> zero_line(const PlaneMap& map, const std::vector<float>& values) {
  std::vector<std::array<Point, 2>> pieces;
  if (values.size() != map.code.size()) return pieces;  // the same everywhere
  const Field field(map, values);
  constexpr int corner[5][2]{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  for (int row = -1; row < map.y.pixels; ++row)
    for (int column = -1; column < map.x.pixels; ++column) {
      std::vector<Point> crossings;
      for (int edge = 0; edge < 4; ++edge) {
        const int c0 = column + corner[edge][0], r0 = row + corner[edge][1];
        const int c1 = column + corner[edge + 1][0], r1 = row + corner[edge + 1][1];
        const double a = field.value(c0, r0), b = field.value(c1, r1);
        if (!std::isfinite(a) || !std::isfinite(b) || (a < 0.0) == (b < 0.0)) continue;
        const Point from = field.place(c0, r0), to = field.place(c1, r1);
        const double s = a / (a - b);
        crossings.push_back({from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])});
      }
      for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) pieces.push_back({crossings[k], crossings[k + 1]});
    }
  return pieces;
}

std::string line_block(const std::string& name, const std::vector<std::array<Point, 2>>& pieces) {
  std::string text = name + " << EOD\n";
  for (const auto& [a, b] : pieces) text += fmt::format("{:.8g} {:.8g}\n{:.8g} {:.8g}\n\n", a[0], a[1], b[0], b[1]);
  return text + "EOD\n";
}

// How dark pixels are by when they were decided: by rank among those of the same outcome, so that each colour has all
// its shades.
class Shade {
 public:
  Shade(const PlaneMap& map, MapShading shading) : map_(map) {
    if (shading == MapShading::none) return;
    for (std::size_t k = 0; k < map.code.size(); ++k)
      if (map.code[k] > 0 && std::isfinite(map.time[k])) times_[map.code[k]].push_back(map.time[k]);
    for (auto& [code, times] : times_) std::sort(times.begin(), times.end());
  }

  // A packed colour, at least half as bright: the legend's is still recognised.
  int apply(std::size_t pixel, int packed) const {
    constexpr double darkest = 0.5;
    const auto found = times_.find(map_.code[pixel]);
    if (found == times_.end() || !std::isfinite(map_.time[pixel])) return packed;
    const std::vector<float>& times = found->second;
    const auto rank = std::lower_bound(times.begin(), times.end(), map_.time[pixel]) - times.begin();
    const double bright = 1.0 - darkest * static_cast<double>(rank) / static_cast<double>(times.size());
    const auto part = [&](int shift) {
      return static_cast<int>(std::lround((packed >> shift & 255) * bright)) << shift;
    };
    return part(16) | part(8) | part(0);
  }

 private:
  const PlaneMap& map_;
  std::map<short, std::vector<float>> times_;  // by outcome
};

// Outcomes as packed red, green and blue.
std::string image_block(const PlaneMap& map, MapShading shading) {
  const Shade shade(map, shading);
  std::string text = "$outcome << EOD\n";
  for (int row = 0; row < map.y.pixels; ++row) {
    for (int column = 0; column < map.x.pixels; ++column) {
      const short code = map.code[map.at(column, row)];
      const char* colour = code == not_computed_code ? "#FFFFFF" : colour_of(code);
      const int packed = static_cast<int>(std::stol(colour + 1, nullptr, 16));
      text += fmt::format("{}{}", column ? " " : "", shade.apply(map.at(column, row), packed));
    }
    text += "\n";
  }
  return text + "EOD\n";
}

std::string share_text(const Share& share) {
  const double percent = 100.0 * share.share;
  return percent > 0.0 && percent < 0.1 ? "< 0.1 %" : fmt::format("{:.1f} %", percent);
}

// An angle's axis has ticks at parts of a turn, unless it shows too little of one.
std::string ticks(const std::string& letter, const MapAxis& axis) {
  if (!axis.angle() || axis.high - axis.low < pi) return "";
  return fmt::format("set {}tics ('0' 0, 'π/2' pi/2, 'π' pi, '3π/2' 3*pi/2, '2π' 2*pi)\n", letter);
}

// In quarter turns where it is some, else as a number.
std::string angle_text(double angle) {
  const double quarters = angle / (0.5 * pi);
  if (std::fabs(quarters - std::round(quarters)) > 1e-9) return fmt::format("{:.4g}", angle);
  const int n = static_cast<int>(std::round(quarters));
  if (n == 0) return "0";
  const std::string times = std::abs(n % 2 ? n : n / 2) == 1 ? "" : fmt::format("{}", std::abs(n % 2 ? n : n / 2));
  return fmt::format("{}{}π{}", n < 0 ? "-" : "", times, n % 2 ? "/2" : "");
}

std::string start_text(const PlaneMap& map) {
  const int balls = map.study.parameters.balls;
  std::string text;
  for (int i = 1; i <= balls; ++i) {
    const std::string key = fmt::format("initial.phi_{}", i);
    if (key == map.x.key || key == map.y.key) continue;
    std::string value = angle_text(map.study.initial.phi[static_cast<std::size_t>(i - 1)]);
    for (const AngleLink& link : map.links)
      if (link.ball == i) value = fmt::format("φ{} + {}", link.of, angle_text(link.offset));
    text += fmt::format(", φ{} = {}", i, value);
  }
  return text;
}

// What the map lacks or leaves out.
std::string making_line(const PlaneMap& map) {
  std::vector<std::string> parts;
  if (!map.complete) parts.emplace_back("PARTIAL: stopped early");
  if (map.block > 0)
    parts.push_back(fmt::format("{:.0f} % of the pixels computed, the others filled in",
                                100.0 * static_cast<double>(map.pixels_computed) / static_cast<double>(map.pixels)));
  if (map.every > 1) parts.push_back(fmt::format("one of {0} x {0} pixels drawn", map.every));
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

std::string map_plot_script(const PlaneMap& whole, const std::string& title, const std::string& path,
                            MapShading shading) {
  const PlaneMap map = thinned(whole, most_drawn_pixels);
  std::string script = canvas(path, 1600, 1000) + image_block(map, shading);
  const auto exists = zero_line(map, map.balance_margin), stable = zero_line(map, map.balance_growth);
  std::string items = fmt::format(
      "$outcome matrix using ({:.10g}+$1*{:.10g}):({:.10g}+$2*{:.10g}):(int($3)/65536):(int($3)/256%256):(int($3)%256) "
      "with rgbimage notitle",
      map.x.centre(0), map.x.step(), map.y.centre(0), map.y.step());
  const auto add = [&](const std::string& item) { items += ", \\\n  " + item; };
  for (const MapCode& c : map.codes) {
    if (c.share.count == 0) continue;
    const std::string name = c.alias.empty() ? c.name : fmt::format("{}: {}", c.alias, c.name);
    add(
        fmt::format("keyentry with filledcurves fillcolor rgb '{}' fillstyle solid 1.0 border linecolor rgb '#444444' "
                    "title {}",
                    colour_of(c.code), quoted(fmt::format("{}, {}", name, share_text(c.share)))));
  }
  const auto add_border = [&](const std::string& name, const auto& pieces, const char* dash, const char* meaning) {
    if (pieces.empty()) return;
    script += line_block(name, pieces);
    add(fmt::format("{} with lines linecolor rgb '#FFFFFF' linewidth 4.5 notitle", name));
    add(fmt::format("{} with lines linecolor rgb '#000000' linewidth 2 {} title {}", name, dash, quoted(meaning)));
  };
  add_border("$exists", exists, "dashtype (10,7)", "balance ends to exist");
  add_border("$stable", stable, "", "balance changes stability");
  const std::string darker = shading == MapShading::none ? "" : "; the darker, the later decided";
  const std::string details = parameters_text(map.study, {map.x.key, map.y.key}) + start_text(map) + darker;
  script += fmt::format("set title {}.\"\\n\".{}.{} offset 0,0.3\n", quoted(title), quoted(details),
                        making_line(map).empty() ? "''" : "\"\\n\"." + quoted(making_line(map)));
  script += fmt::format("set xlabel {}\nset ylabel {} offset -0.6,0\n", quoted(axis_label(map.x.key)),
                        quoted(axis_label(map.y.key)));
  script += fmt::format("set xrange [{:.10g}:{:.10g}]\nset yrange [{:.10g}:{:.10g}]\n", map.x.low, map.x.high,
                        map.y.low, map.y.high);
  script += ticks("x", map.x) + ticks("y", map.y);
  script +=
      "set border linecolor rgb '#444444'\nset tics nomirror out textcolor rgb '#222222'\n"
      "set lmargin 11\nset key outside right top vertical Left reverse samplen 2.2 spacing 1.3 width 1\n";
  script += "plot " + items + "\n";
  return script;
}

}  // namespace equipoise
