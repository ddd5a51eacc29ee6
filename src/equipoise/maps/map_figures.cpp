// Boxes and pairs of pixels, counted at scales that double.
#include "equipoise/maps/map_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "equipoise/base/angles.hpp"
#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/statistics/distributions.hpp"
#include "equipoise/store/basin_file.hpp"

namespace equipoise {

namespace {

constexpr double confidence = 0.95;
constexpr short no_outcome = 0;

// Outcomes alone, with a code of 0 for what is none.
class Outcomes {
 public:
  explicit Outcomes(const PlaneMap& map) : columns_(map.x.pixels), rows_(map.y.pixels), codes_(map.code) {
    for (short& code : codes_)
      if (code == undecided_code || code == failed_code || code == not_computed_code) code = no_outcome;
  }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  short at(int column, int row) const {
    return codes_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
  }

 private:
  int columns_, rows_;
  std::vector<short> codes_;
};

struct ScalePoint {
  double scale = 0.0, count = 0.0;  // pixels; boxes or share
};

// Slope of log count over log scale, with the interval of its straight line. Empty for fewer than four scales.
std::optional<MapFigure> slope(const std::vector<ScalePoint>& points) {
  constexpr std::size_t fewest = 4;
  const double n = static_cast<double>(points.size());
  if (points.size() < fewest) return std::nullopt;
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, rest = 0.0;
  for (const ScalePoint& p : points) {
    x += std::log(p.scale) / n;
    y += std::log(p.count) / n;
  }
  for (const ScalePoint& p : points) {
    const double dx = std::log(p.scale) - x;
    xx += dx * dx;
    xy += dx * (std::log(p.count) - y);
  }
  const double value = xy / xx;
  for (const ScalePoint& p : points) {
    const double d = std::log(p.count) - y - value * (std::log(p.scale) - x);
    rest += d * d;
  }
  const double half = students_t_half_width(n - 2.0, confidence) * std::sqrt(rest / (n - 2.0) / xx);
  return MapFigure{value, value - half, value + half};
}

// Scales from a pixel up to an eighth of the shorter side: larger ones see the map's edges.
std::vector<int> scales(const Outcomes& o) {
  std::vector<int> result;
  for (int s = 1; 8 * s <= std::min(o.columns(), o.rows()); s *= 2) result.push_back(s);
  return result;
}

// Whether pixels with different outcomes are among those on and in a box of side `s` between pixel centres.
bool mixed(const Outcomes& o, int column, int row, int s) {
  short first = no_outcome;
  for (int r = row; r <= row + s; ++r)
    for (int c = column; c <= column + s; ++c) {
      const short code = o.at(c, r);
      if (code == no_outcome) continue;
      if (first == no_outcome) first = code;
      if (code != first) return true;
    }
  return false;
}

// Boxes lie side by side. A largest scale with few boxes on the boundary says little.
std::optional<MapFigure> box_dimension(const Outcomes& o) {
  constexpr double fewest_boxes = 16.0;
  std::vector<ScalePoint> points;
  for (const int s : scales(o)) {
    double boxes = 0.0;
    for (int row = 0; row + s < o.rows(); row += s)
      for (int column = 0; column + s < o.columns(); column += s) boxes += mixed(o, column, row, s);
    if (boxes >= fewest_boxes) points.push_back({static_cast<double>(s), boxes});
  }
  auto figure = slope(points);
  if (figure) *figure = {-figure->value, -figure->high, -figure->low};
  return figure;
}

std::optional<MapFigure> uncertainty_exponent(const Outcomes& o) {
  std::vector<ScalePoint> points;
  for (const int e : scales(o)) {
    std::uint64_t pairs = 0, uncertain = 0;
    const auto see = [&](short here, short there) {
      if (here == no_outcome || there == no_outcome) return;
      ++pairs;
      uncertain += here != there;
    };
    for (int row = 0; row < o.rows(); ++row)
      for (int column = 0; column < o.columns(); ++column) {
        const short here = o.at(column, row);
        if (column + e < o.columns()) see(here, o.at(column + e, row));
        if (row + e < o.rows()) see(here, o.at(column, row + e));
      }
    if (uncertain > 0)
      points.push_back({static_cast<double>(e), static_cast<double>(uncertain) / static_cast<double>(pairs)});
  }
  return slope(points);
}

std::optional<MapFigure> mean(const std::vector<double>& values) {
  constexpr std::size_t fewest = 16;
  if (values.size() < fewest) return std::nullopt;
  const double n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double v : values) sum += v;
  for (const double v : values) squares += (v - sum / n) * (v - sum / n);
  const double half = normal_half_width(confidence) * std::sqrt(squares / (n - 1.0) / n);
  return MapFigure{sum / n, sum / n - half, sum / n + half};
}

struct Entropies {
  std::vector<double> all, boundary;
};

Entropies box_entropies(const Outcomes& o) {
  constexpr int side = 5;
  Entropies result;
  for (int row = 0; row + side <= o.rows(); row += side)
    for (int column = 0; column + side <= o.columns(); column += side) {
      std::map<short, double> counts;
      double total = 0.0, entropy = 0.0;
      for (int r = row; r < row + side; ++r)
        for (int c = column; c < column + side; ++c)
          if (const short code = o.at(c, r); code != no_outcome) {
            ++counts[code];
            ++total;
          }
      if (total == 0.0) continue;
      for (const auto& [code, count] : counts) entropy -= count / total * std::log(count / total);
      result.all.push_back(entropy);
      if (counts.size() > 1) result.boundary.push_back(entropy);
    }
  return result;
}

// Of centres of pixels, less half a pixel's diagonal; up to an edge of the map where it does not close on itself.
std::optional<double> radius_around(const PlaneMap& map, double x, double y) {
  const auto closes = [](const MapAxis& a) { return a.high - a.low >= two_pi * (1.0 - 1e-9); };
  const auto inside = [&](const MapAxis& a, double v) { return closes(a) ? two_pi : std::min(v - a.low, a.high - v); };
  // The angle as the axis counts it.
  const auto on = [](const MapAxis& a, double v) { return a.low + wrapped_positive(v - a.low); };
  double radius = std::min(inside(map.x, on(map.x, x)), inside(map.y, on(map.y, y)));
  if (radius < 0.0) return std::nullopt;  // not in the map
  const double diagonal = 0.5 * std::hypot(map.x.step(), map.y.step());
  for (int row = 0; row < map.y.pixels; ++row)
    for (int column = 0; column < map.x.pixels; ++column) {
      if (map.code[map.at(column, row)] == balanced_id) continue;
      radius =
          std::min(radius, std::hypot(wrapped(map.x.centre(column) - x), wrapped(map.y.centre(row) - y)) - diagonal);
    }
  return std::max(0.0, radius);
}

std::optional<double> balanced_radius(const PlaneMap& map) {
  const bool both = map.x.key == "initial.phi_1" && map.y.key == "initial.phi_2";
  const bool swapped = map.x.key == "initial.phi_2" && map.y.key == "initial.phi_1";
  if (map.study.parameters.balls != 2 || !(both || swapped) || !map.links.empty()) return std::nullopt;
  std::optional<double> largest;
  for (const auto& phi : model::balanced_states(map.study.parameters).angles) {
    const auto radius = radius_around(map, phi[swapped ? 1 : 0], phi[swapped ? 0 : 1]);
    if (radius) largest = std::max(largest.value_or(0.0), *radius);
  }
  return largest;
}

}  // namespace

MapFigures map_figures(const PlaneMap& map) {
  MapFigures figures;
  if (!map.complete) return figures;
  const Outcomes outcomes(map);
  figures.box_dimension = box_dimension(outcomes);
  figures.uncertainty_exponent = uncertainty_exponent(outcomes);
  const Entropies entropies = box_entropies(outcomes);
  figures.basin_entropy = mean(entropies.all);
  figures.boundary_basin_entropy = mean(entropies.boundary);
  figures.balanced_radius = balanced_radius(map);
  return figures;
}

}  // namespace equipoise
