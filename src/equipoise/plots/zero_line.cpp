// Crossings of zero between neighbouring pixels.
#include "equipoise/plots/zero_line.hpp"

#include <algorithm>
#include <cmath>

namespace equipoise {

namespace {

// A field known at the pixels' centres, extrapolated linearly to the edges.
class MapField {
 public:
  MapField(const BasinSlice& map, const std::vector<float>& values) : map_(map), values_(values) {}

  double value(int column, int row) const {
    const Weights a = weights(column, map_.x.pixels), b = weights(row, map_.y.pixels);
    double sum = 0.0;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        if (a.share[i] * b.share[j] != 0.0) sum += a.share[i] * b.share[j] * values_[map_.at(a.pixel[i], b.pixel[j])];
    // A change of sign that is only extrapolated does not count.
    const double nearest = values_[map_.at(a.pixel[0], b.pixel[0])];
    return (sum < 0.0) == (nearest < 0.0) ? sum : nearest;
  }
  MapPoint place(int column, int row) const { return {along(map_.x, column), along(map_.y, row)}; }

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
  static double along(const SliceAxis& axis, int k) { return std::clamp(axis.centre(k), axis.low, axis.high); }
  const BasinSlice& map_;
  const std::vector<float>& values_;
};

}  // namespace

std::vector<std::array<MapPoint, 2>> zero_line(const BasinSlice& map, const std::vector<float>& values) {
  std::vector<std::array<MapPoint, 2>> pieces;
  if (values.size() != map.code.size()) return pieces;  // the same everywhere
  const MapField field(map, values);
  constexpr int corner[5][2]{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  for (int row = -1; row < map.y.pixels; ++row)
    for (int column = -1; column < map.x.pixels; ++column) {
      std::vector<MapPoint> crossings;
      for (int edge = 0; edge < 4; ++edge) {
        const int c0 = column + corner[edge][0], r0 = row + corner[edge][1];
        const int c1 = column + corner[edge + 1][0], r1 = row + corner[edge + 1][1];
        const double a = field.value(c0, r0), b = field.value(c1, r1);
        if (!std::isfinite(a) || !std::isfinite(b) || (a < 0.0) == (b < 0.0)) continue;
        const MapPoint from = field.place(c0, r0), to = field.place(c1, r1);
        const double s = a / (a - b);
        crossings.push_back({from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])});
      }
      for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) pieces.push_back({crossings[k], crossings[k + 1]});
    }
  return pieces;
}

}  // namespace equipoise
