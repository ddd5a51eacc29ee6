// Spin-ups as points of a cube: every point of it is one that keeps to the limits on speed and slope.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "equipoise/results/design_result.hpp"

namespace equipoise {

struct SpinUpPoints {
  std::vector<double> times, speeds;  ///< from 0 and the initial speed to the final one
};

/// Coordinates: a speed a point, then a share of the time that is left a piece.
inline std::size_t coordinates(const SpinUpShape& shape) { return 2 * static_cast<std::size_t>(shape.points) + 1; }

/// Time that the straight way from the initial to the final speed takes at the least.
double shortest_spin_up(const SpinUpShape& shape);

/// `at`: coordinates(shape) numbers from 0 to 1. Every piece is given the time that its change of speed needs; what is
/// left of `until` is broken like a stick among the pieces and what follows on them, evenly over all ways to do so if
/// the coordinates are even. Speeds that need more time than there is are drawn towards the straight way.
SpinUpPoints spin_up_at(const SpinUpShape& shape, std::span<const double> at);

}  // namespace equipoise
