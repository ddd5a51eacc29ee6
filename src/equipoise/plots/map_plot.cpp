// The script: the image, the limits of balance, the legend.
#include "equipoise/plots/map_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/drawing/plot_parts.hpp"
#include "equipoise/plots/map_words.hpp"
#include "equipoise/plots/zero_line.hpp"
#include "equipoise/words/plots.hpp"

namespace equipoise {

namespace {

// Along one side: more than the canvas shows.
constexpr int most_drawn_pixels = 1600;

std::string line_block(const std::string& name, const std::vector<std::array<MapPoint, 2>>& pieces) {
  std::string text = name + " << EOD\n";
  for (const auto& [a, b] : pieces) text += fmt::format("{:.8g} {:.8g}\n{:.8g} {:.8g}\n\n", a[0], a[1], b[0], b[1]);
  return text + "EOD\n";
}

// Darkness of pixels by their time of decision: by rank within one outcome, so that each colour has all its shades.
class Shade {
 public:
  Shade(const BasinSlice& map, SliceShading shading) : map_(map) {
    if (shading == SliceShading::none) return;
    for (std::size_t k = 0; k < map.code.size(); ++k)
      if (map.code[k] > 0 && std::isfinite(map.time[k])) times_[map.code[k]].push_back(map.time[k]);
    for (auto& [code, times] : times_) std::sort(times.begin(), times.end());
  }

  // A packed colour, at least half as bright: still recognisable in the legend.
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
  const BasinSlice& map_;
  std::map<short, std::vector<float>> times_;  // by outcome
};

// Outcomes as packed red, green and blue.
std::string image_block(const BasinSlice& map, SliceShading shading) {
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
std::string ticks(const std::string& letter, const SliceAxis& axis) {
  if (!axis.angle() || axis.high - axis.low < pi) return "";
  return fmt::format("set {}tics ('0' 0, 'π/2' pi/2, 'π' pi, '3π/2' 3*pi/2, '2π' 2*pi)\n", letter);
}

}  // namespace

std::string map_plot_script(const BasinSlice& whole, const std::string& title, const std::string& path,
                            SliceShading shading) {
  const BasinSlice map = thinned(whole, most_drawn_pixels);
  std::string script = canvas(path, 1600, 1000) + image_block(map, shading);
  const auto exists = zero_line(map, map.balance_margin), stable = zero_line(map, map.balance_growth);
  std::string items = fmt::format(
      "$outcome matrix using ({:.10g}+$1*{:.10g}):({:.10g}+$2*{:.10g}):(int($3)/65536):(int($3)/256%256):(int($3)%256) "
      "with rgbimage notitle",
      map.x.centre(0), map.x.step(), map.y.centre(0), map.y.step());
  const auto add = [&](const std::string& item) { items += ", \\\n  " + item; };
  for (const OutcomeShare& c : map.codes) {
    if (c.share.count == 0) continue;
    add(
        fmt::format("keyentry with filledcurves fillcolor rgb '{}' fillstyle solid 1.0 border linecolor rgb '#444444' "
                    "title {}",
                    colour_of(c.id), quoted(fmt::format("{}, {}", legend_of(c), share_text(c.share)))));
  }
  const auto add_border = [&](const std::string& name, const auto& pieces, const char* dash, const char* meaning) {
    if (pieces.empty()) return;
    script += line_block(name, pieces);
    add(fmt::format("{} with lines linecolor rgb '#FFFFFF' linewidth 4.5 notitle", name));
    add(fmt::format("{} with lines linecolor rgb '#000000' linewidth 2 {} title {}", name, dash, quoted(meaning)));
  };
  add_border("$exists", exists, "dashtype (10,7)", words::plots::balance_ends);
  add_border("$stable", stable, "", words::plots::balance_changes);
  const std::string darker = shading == SliceShading::none ? "" : words::plots::darker_is_later;
  const std::string details = parameters_text(map.study, {map.x.key, map.y.key}) + fixed_angles_text(map) + darker;
  script += fmt::format("set title {}.\"\\n\".{}.{} offset 0,0.3\n", quoted(title), quoted(details),
                        map_making_text(map).empty() ? "''" : "\"\\n\"." + quoted(map_making_text(map)));
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
