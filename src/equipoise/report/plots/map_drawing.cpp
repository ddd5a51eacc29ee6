// Pixels as a picture in axes, limits of balance, legend.
#include "equipoise/report/plots/plots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/report/plots/plane_frame.hpp"

namespace equipoise {

namespace {

// Darkness of pixels by their time of decision: by rank within one outcome, so that each colour has all its shades, and
// at least half as bright, so that the legend's colour is recognised.
class Shade {
 public:
  explicit Shade(const BasinSlice& map) : map_(map) {
    for (std::size_t k = 0; k < map.code.size(); ++k)
      if (map.code[k] > 0 && std::isfinite(map.time[k])) outcomes_[map.code[k]].times.push_back(map.time[k]);
    for (auto& [code, outcome] : outcomes_) {
      std::sort(outcome.times.begin(), outcome.times.end());
      for (std::size_t k = 0; k < shades; ++k)
        outcome.colours[k] = mixed_colour(colour_of(code), "#000000", 0.5 * static_cast<double>(k) / shades);
    }
  }

  std::string colour(std::size_t pixel) const {
    const short code = map_.code[pixel];
    if (code == not_computed_code) return "#ffffff";
    const auto found = outcomes_.find(code);
    if (found == outcomes_.end() || !std::isfinite(map_.time[pixel])) return colour_of(code);
    const auto& [times, colours] = found->second;
    const auto rank = std::lower_bound(times.begin(), times.end(), map_.time[pixel]) - times.begin();
    return colours[static_cast<std::size_t>(rank) * shades / times.size()];
  }

 private:
  static constexpr std::size_t shades = 8;
  struct Outcome {
    std::vector<float> times;
    std::array<std::string, shades> colours;
  };
  const BasinSlice& map_;
  std::map<short, Outcome> outcomes_;
};

std::string map_svg(const BasinSlice& map) {
  PlanePicture picture("Outcome of the start at every point of the plane", map.study, map.x, map.y);
  const Shade shade(map);
  picture.fill(map.x.pixels, map.y.pixels, [&](int column, int row) { return shade.colour(map.at(column, row)); });
  for (const OutcomeShare& c : map.codes)
    if (c.share.count > 0)
      picture.legend.push_back({{"", colour_of(c.id)}, fmt::format("{}, {}", legend_of(c), part_words(c.share.share))});
  picture.draw(
      {{zero_line(map.x, map.y, map.balance_margin), {"#000000", "", 1.5, 1.0, true}, "balance ceases to exist"},
       {zero_line(map.x, map.y, map.balance_growth), {"#000000", "", 1.5}, "stability of balance changes"}});
  return picture.str();
}

}  // namespace

DrawingRow map_drawing(const BasinSlice& whole) {
  const BasinSlice map = thinned(whole, most_drawn_pixels);
  DrawingRow row{
      {{"", map_svg(map)}}, "One start at every point. Darker pixels were decided later.", DrawingSize::wide};
  if (map.every > 1) row.caption += fmt::format(" One of {0} x {0} points is drawn.", map.every);
  row.details = parameters_text(map.study, {map.x.key, map.y.key}) + (map.complete ? "" : " (PARTIAL: stopped early)");
  return row;
}

}  // namespace equipoise
