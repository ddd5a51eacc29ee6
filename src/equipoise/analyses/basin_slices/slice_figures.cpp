// Counts boxes and pairs of pixels at scales that double.
#include "equipoise/analyses/basin_slices/slice_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/statistics/distributions.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

namespace {

constexpr double confidence = 0.95;
constexpr short no_outcome = 0, mixed_outcome = std::numeric_limits<short>::max();
constexpr int entropy_side = 5;

short outcome_of_code(short code) {
  const bool none = code == undecided_code || code == failed_code || code == not_computed_code;
  return none || code == left_out_code ? no_outcome : code;
}

// Outcome of two sets of pixels together.
short joined(short a, short b) { return a == no_outcome || a == b ? b : b == no_outcome ? a : mixed_outcome; }

struct ScalePoint {
  double scale = 0.0, count = 0.0;  // pixels; boxes or share
};

// Slope of log count over log scale, with the interval of the fitted line. Empty for fewer than four scales.
std::optional<Estimate> slope(const std::vector<ScalePoint>& points) {
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
  return Estimate{value, value - half, value + half};
}

// Scales from one pixel to an eighth of the shorter side: larger ones are affected by the edges.
std::vector<int> figure_scales(int columns, int rows) {
  std::vector<int> result;
  for (int s = 1; 8 * s <= std::min(columns, rows); s *= 2) result.push_back(s);
  return result;
}

std::optional<Estimate> mean(const std::map<double, std::uint64_t>& values) {
  constexpr double fewest = 16.0;
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (const auto& [value, count] : values) {
    n += static_cast<double>(count);
    sum += value * static_cast<double>(count);
  }
  if (n < fewest) return std::nullopt;
  for (const auto& [value, count] : values)
    squares += static_cast<double>(count) * (value - sum / n) * (value - sum / n);
  const double half = normal_half_width(confidence) * std::sqrt(squares / (n - 1.0) / n);
  return Estimate{sum / n, sum / n - half, sum / n + half};
}

// Balanced angles in a slice over both angles of two balls, as (x, y).
std::vector<std::pair<double, double>> balanced_points(const BasinSlice& map) {
  std::vector<std::pair<double, double>> points;
  const bool both = map.x.key == "initial.phi_1" && map.y.key == "initial.phi_2";
  const bool swapped = map.x.key == "initial.phi_2" && map.y.key == "initial.phi_1";
  if (map.study.parameters.balls != 2 || !(both || swapped) || !map.links.empty()) return points;
  for (const auto& phi : model::balanced_states(map.study.parameters).angles)
    points.emplace_back(phi[swapped ? 1 : 0], phi[swapped ? 0 : 1]);
  return points;
}

// Distance along an axis from an angle to the nearer end, counting the angle as the axis does; negative if outside.
double room_on(const SliceAxis& a, double angle) {
  if (a.high - a.low >= two_pi * (1.0 - 1e-9)) return two_pi;  // closes on itself
  const double there = a.low + wrapped_positive(angle - a.low);
  return std::min(there - a.low, a.high - there);
}

}  // namespace

SliceFigureCount::SliceFigureCount(const BasinSlice& plane)
    : x_(plane.x),
      y_(plane.y),
      scales_(figure_scales(plane.x.pixels, plane.y.pixels)),
      boxes_(scales_.size()),
      pairs_(scales_.size()) {
  for (std::size_t k = 0; k < scales_.size(); ++k)
    boxes_[k].outcome.assign(static_cast<std::size_t>((x_.pixels - 1) / scales_[k]), no_outcome);
  before_.resize(scales_.empty() ? 1 : static_cast<std::size_t>(scales_.back()));
  prepare_discs(plane);
}

void SliceFigureCount::add_row(const short* codes) {
  Row row(static_cast<std::size_t>(x_.pixels));
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = outcome_of_code(codes[k]);
  add_pairs(row);
  add_boxes(row);
  add_discs(codes);
  band_.push_back(row);
  if (band_.size() == entropy_side) add_entropies();
  before_[static_cast<std::size_t>(row_) % before_.size()] = std::move(row);
  ++row_;
}

// A box of side 1 has four pixels at its corners; a box of twice the side consists of four adjacent ones.
void SliceFigureCount::add_boxes(const Row& row) {
  if (row_ == 0 || scales_.empty()) return;
  const Row& below = before_[static_cast<std::size_t>(row_ - 1) % before_.size()];
  Boxes& smallest = boxes_.front();
  for (std::size_t k = 0; k < smallest.outcome.size(); ++k)
    smallest.outcome[k] = joined(joined(below[k], below[k + 1]), joined(row[k], row[k + 1]));
  pass_up(0);
}

// A row of boxes is complete: count it and join it into larger boxes.
void SliceFigureCount::pass_up(std::size_t scale) {
  Boxes& whole = boxes_[scale];
  whole.mixed += static_cast<double>(std::count(whole.outcome.begin(), whole.outcome.end(), mixed_outcome));
  if (scale + 1 < boxes_.size()) {
    Boxes& larger = boxes_[scale + 1];
    for (std::size_t k = 0; k < larger.outcome.size(); ++k)
      larger.outcome[k] = joined(larger.outcome[k], joined(whole.outcome[2 * k], whole.outcome[2 * k + 1]));
    if (++larger.parts == 2) pass_up(scale + 1);
  }
  std::fill(whole.outcome.begin(), whole.outcome.end(), no_outcome);
  whole.parts = 0;
}

void SliceFigureCount::add_pairs(const Row& row) {
  const auto see = [](const short* here, const short* there, std::size_t count, Pairs& pairs) {
    std::uint32_t all = 0, unlike = 0;  // of a row
    for (std::size_t k = 0; k < count; ++k) {
      const bool both = (here[k] != no_outcome) & (there[k] != no_outcome);
      all += both;
      unlike += both & (here[k] != there[k]);
    }
    pairs.all += all;
    pairs.unlike += unlike;
  };
  for (std::size_t k = 0; k < scales_.size(); ++k) {
    const int e = scales_[k];
    see(row.data(), row.data() + e, row.size() - static_cast<std::size_t>(e), pairs_[k]);
    if (row_ < e) continue;
    see(before_[static_cast<std::size_t>(row_ - e) % before_.size()].data(), row.data(), row.size(), pairs_[k]);
  }
}

void SliceFigureCount::add_entropies() {
  for (std::size_t column = 0; column + entropy_side <= band_.front().size(); column += entropy_side) {
    std::array<short, entropy_side * entropy_side> codes;
    auto end = codes.begin();
    for (const Row& row : band_)
      for (std::size_t c = column; c < column + entropy_side; ++c)
        if (row[c] != no_outcome) *end++ = row[c];
    if (end == codes.begin()) continue;
    std::sort(codes.begin(), end);
    const double total = static_cast<double>(end - codes.begin());
    double entropy = 0.0;
    for (auto first = codes.begin(); first != end;) {
      const auto next = std::upper_bound(first, end, *first);
      const double part = static_cast<double>(next - first) / total;
      entropy -= part * std::log(part);
      first = next;
    }
    ++all_[entropy];
    if (codes.front() != *(end - 1)) ++boundary_[entropy];
  }
  band_.clear();
}

void SliceFigureCount::prepare_discs(const BasinSlice& plane) {
  for (const auto& [x, y] : balanced_points(plane)) {
    Disc disc{x, y, std::min(room_on(x_, x), room_on(y_, y)), {}};
    if (disc.edge < 0.0) continue;  // not in the map
    for (int column = 0; column < x_.pixels; ++column) disc.across.push_back(wrapped(x_.centre(column) - x));
    discs_.push_back(std::move(disc));
  }
}

void SliceFigureCount::add_discs(const short* codes) {
  for (Disc& disc : discs_) {
    const double dy = wrapped(y_.centre(row_) - disc.y);
    double least = disc.touched ? disc.dx * disc.dx + disc.dy * disc.dy : std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < disc.across.size(); ++k) {
      const double dx = disc.across[k], square = dx * dx + dy * dy;
      if (codes[k] == balanced_id || codes[k] == left_out_code || square >= least) continue;
      least = square;
      disc.dx = dx;
      disc.dy = dy;
      disc.touched = true;
    }
  }
}

SliceFigures SliceFigureCount::figures() const {
  constexpr double fewest_boxes = 16.0;  // a largest scale with few boxes on the boundary says little
  SliceFigures figures;
  std::vector<ScalePoint> boxes, uncertain;
  for (std::size_t k = 0; k < scales_.size(); ++k) {
    const double scale = scales_[k];
    if (boxes_[k].mixed >= fewest_boxes) boxes.push_back({scale, boxes_[k].mixed});
    if (pairs_[k].unlike > 0)
      uncertain.push_back({scale, static_cast<double>(pairs_[k].unlike) / static_cast<double>(pairs_[k].all)});
  }
  figures.box_dimension = slope(boxes);
  if (auto& d = figures.box_dimension) *d = {-d->value, -d->high, -d->low};
  figures.uncertainty_exponent = slope(uncertain);
  for (std::size_t k = 1; k < uncertain.size(); ++k) {
    const ScalePoint &a = uncertain[k - 1], &b = uncertain[k];
    figures.local_exponents.push_back({static_cast<int>(a.scale), static_cast<int>(b.scale),
                                       std::log(b.count / a.count) / std::log(b.scale / a.scale)});
  }
  figures.basin_entropy = mean(all_);
  figures.boundary_basin_entropy = mean(boundary_);
  // From pixel centres, less half a pixel's diagonal; up to the edge of a slice that does not close on itself.
  const double diagonal = 0.5 * std::hypot(x_.step(), y_.step());
  for (const Disc& d : discs_) {
    const double radius = d.touched ? std::min(d.edge, std::hypot(d.dx, d.dy) - diagonal) : d.edge;
    figures.balanced_radius = std::max({figures.balanced_radius.value_or(0.0), radius, 0.0});
  }
  return figures;
}

}  // namespace equipoise
