// A flood through neighbours that are alike; a region's own place is the point furthest from its edge.
#include "equipoise/extras/curves/curve_starts.hpp"

#include <algorithm>
#include <map>

namespace equipoise {

namespace {

// Points of one region agree in this: how many states of each kind are stable and unstable.
ChartRegion region_like(const RegionPattern& pattern) {
  ChartRegion region;
  region.balance = pattern.balance;
  for (const std::vector<int>& states : pattern.unstable) {
    const auto stable = static_cast<int>(std::count(states.begin(), states.end(), 0));
    region.locked.push_back({stable, static_cast<int>(states.size()) - stable});
  }
  return region;
}

class Flood {
 public:
  Flood(const StabilityPlane& grid, const std::vector<int>& label)
      : columns_(grid.x.pixels), rows_(grid.y.pixels), label_(label), region_(label.size(), -1) {}

  // Points of the region that begins at `start`.
  std::vector<std::size_t> from(std::size_t start, int number) {
    std::vector<std::size_t> points{start};
    region_[start] = number;
    for (std::size_t k = 0; k < points.size(); ++k)
      neighbours(points[k], [&](std::size_t next) {
        if (region_[next] >= 0 || label_[next] != label_[start]) return;
        region_[next] = number;
        points.push_back(next);
      });
    return points;
  }
  // Peels the region until nothing is left.
  std::size_t innermost(std::vector<std::size_t> points) const {
    std::vector<char> peeled(label_.size(), 0);
    std::size_t last = points.front();
    while (!points.empty()) {
      last = points[points.size() / 2];
      std::vector<std::size_t> inner, edge;
      for (const std::size_t p : points) {
        bool inside = on_grid_inside(p);
        neighbours(p, [&](std::size_t next) { inside = inside && region_[next] == region_[p] && !peeled[next]; });
        (inside ? inner : edge).push_back(p);
      }
      for (const std::size_t p : edge) peeled[p] = 1;
      points = std::move(inner);
    }
    return last;
  }
  const std::vector<int>& regions() const { return region_; }

 private:
  bool on_grid_inside(std::size_t p) const {
    const int column = static_cast<int>(p) % columns_, row = static_cast<int>(p) / columns_;
    return column > 0 && row > 0 && column + 1 < columns_ && row + 1 < rows_;
  }
  template <class Look>
  void neighbours(std::size_t p, const Look& look) const {
    const auto width = static_cast<std::size_t>(columns_);
    const int column = static_cast<int>(p) % columns_, row = static_cast<int>(p) / columns_;
    if (column > 0) look(p - 1);
    if (column + 1 < columns_) look(p + 1);
    if (row > 0) look(p - width);
    if (row + 1 < rows_) look(p + width);
  }

  int columns_, rows_;
  const std::vector<int>& label_;
  std::vector<int> region_;
};

}  // namespace

void add_regions(const std::vector<RegionPattern>& patterns, const std::vector<int>& pattern_of,
                 BifurcationChart& chart) {
  std::vector<ChartRegion> kinds;
  std::vector<int> kind_of;  // by pattern
  for (const RegionPattern& pattern : patterns) {
    const ChartRegion region = region_like(pattern);
    const auto same = std::find_if(kinds.begin(), kinds.end(), [&](const ChartRegion& other) {
      return other.balance == region.balance && other.locked == region.locked;
    });
    kind_of.push_back(static_cast<int>(same - kinds.begin()));
    if (same == kinds.end()) kinds.push_back(region);
  }
  std::vector<int> label;
  label.reserve(pattern_of.size());
  for (const int pattern : pattern_of) label.push_back(kind_of[static_cast<std::size_t>(pattern)]);
  Flood flood(chart.plane, label);
  std::vector<ChartRegion> found;
  for (std::size_t k = 0; k < label.size(); ++k) {
    if (flood.regions()[k] >= 0) continue;
    ChartRegion region = kinds[static_cast<std::size_t>(label[k])];
    const auto points = flood.from(k, static_cast<int>(found.size()));
    region.points = points.size();
    region.part = static_cast<double>(points.size()) / static_cast<double>(label.size());
    const std::size_t inner = flood.innermost(points);
    region.x = chart.plane.x.centre(static_cast<int>(inner) % chart.plane.x.pixels);
    region.y = chart.plane.y.centre(static_cast<int>(inner) / chart.plane.x.pixels);
    found.push_back(std::move(region));
  }
  std::vector<std::size_t> order(found.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return found[a].points > found[b].points; });
  std::vector<int> place(found.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    place[order[k]] = static_cast<int>(k);
    chart.regions.push_back(std::move(found[order[k]]));
  }
  for (const int region : flood.regions()) chart.region_of.push_back(place[static_cast<std::size_t>(region)]);
}

}  // namespace equipoise
