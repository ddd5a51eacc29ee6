// Finds the pairs of balls that an axis moves apart, and where they meet.
#include "equipoise/analyses/basin_slices/invariant_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "equipoise/analyses/basin_slices/slice_axis.hpp"
#include "equipoise/analyses/basin_slices/start_pixels.hpp"
#include "equipoise/core/base/angles.hpp"

namespace equipoise {

InvariantPixels::InvariantPixels(const BasinSlice& plane) {
  if (draws_starts(plane)) return;
  const model::Parameters p = study_at(plane, 0, 0).parameters;
  const auto start = [&](int column, int row) { return start_at(plane, column, row); };
  const InitialState corner = start(0, 0);
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < i; ++k) {
      if (!p.balls_collide() && !p.alike(i, k)) continue;
      const auto angle = [&](const InitialState& s) { return s.phi[i] - s.phi[k]; };
      const auto rate = [&](const InitialState& s) { return s.phi_dot[i] - s.phi_dot[k]; };
      Pair pair;
      if (p.balls_collide()) pair.meet = {p.contact_angle, std::numeric_limits<double>::infinity()};
      for (int column = 0; column < plane.x.pixels; ++column) {
        pair.angle_of_column.push_back(angle(start(column, 0)));
        pair.rate_of_column.push_back(rate(start(column, 0)));
      }
      for (int row = 0; row < plane.y.pixels; ++row) {
        pair.angle_of_row.push_back(angle(start(0, row)) - angle(corner));
        pair.rate_of_row.push_back(rate(start(0, row)) - rate(corner));
      }
      const auto varies = [](const std::vector<double>& values) {
        return std::any_of(values.begin(), values.end(), [&](double v) { return v != values.front(); });
      };
      if (varies(pair.angle_of_column) || varies(pair.angle_of_row) || varies(pair.rate_of_column) ||
          varies(pair.rate_of_row))
        pairs_.push_back(std::move(pair));
      else
        everywhere_ = everywhere_ || model::coincide(p, i, k, corner.phi.data(), corner.phi_dot.data());
    }
  if (pairs_.empty()) return;
  for (int row = 0; row < plane.y.pixels; ++row)
    for (int column = 0; column < plane.x.pixels; ++column) count_ += holds(column, row);
  if (count_ < pixels_of(plane.x, plane.y)) return;
  pairs_.clear();
  count_ = 0;
  everywhere_ = true;
}

bool InvariantPixels::holds(int column, int row) const {
  const auto x = static_cast<std::size_t>(column), y = static_cast<std::size_t>(row);
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
    return std::fabs(pair.rate_of_column[x] + pair.rate_of_row[y]) < pair.meet.rate &&
           std::fabs(wrapped(pair.angle_of_column[x] + pair.angle_of_row[y])) < pair.meet.angle;
  });
}

}  // namespace equipoise
