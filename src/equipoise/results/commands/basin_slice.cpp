// Thins large basin slices.
#include "equipoise/results/commands/basin_slice.hpp"

#include <algorithm>

namespace equipoise {

bool draws_starts(const BasinSlice& map) {
  const auto is_start = [](const SliceAxis& axis) { return axis.key.starts_with("initial."); };
  return !is_start(map.x) && !is_start(map.y) && !states_angles(map.study);
}

SliceAxis thinned(const SliceAxis& axis, int every) {
  if (every == 1) return axis;
  SliceAxis result = axis;
  result.pixels = (axis.pixels - 1 - first_of(every)) / every + 1;
  result.low = axis.low + (first_of(every) + 0.5 - 0.5 * every) * axis.step();
  result.high = result.low + static_cast<double>(result.pixels) * every * axis.step();
  return result;
}

BasinSlice thinned(const BasinSlice& map, int most) {
  const int most_pixels = std::max(map.x.pixels, map.y.pixels), least = std::min(map.x.pixels, map.y.pixels);
  const int every = std::min((most_pixels + most - 1) / most, least);  // at least one pixel of either side is left
  if (every <= 1) return map;
  BasinSlice result;
  result.study = map.study;
  result.x = thinned(map.x, every);
  result.y = thinned(map.y, every);
  result.every = map.every * every;
  result.links = map.links;
  const auto thin = [&](const auto& values, auto& kept) {
    if (values.size() != map.code.size()) {  // the same everywhere, or none
      kept = values;
      return;
    }
    for (int row = first_of(every); row < map.y.pixels; row += every)
      for (int column = first_of(every); column < map.x.pixels; column += every)
        kept.push_back(values[map.at(column, row)]);
  };
  thin(map.code, result.code);
  for (const PixelNumber& n : pixel_numbers) thin(map.*n.all, result.*n.all);
  result.codes = map.codes;
  result.figures = map.figures;
  result.complete = map.complete;
  result.pixels = map.pixels;
  result.pixels_computed = map.pixels_computed;
  result.pixels_left_out = map.pixels_left_out;
  result.balls_together = map.balls_together;
  return result;
}

}  // namespace equipoise
