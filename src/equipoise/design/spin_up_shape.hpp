// Spin-ups as points of a cube, all within the limits on speed and slope.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "equipoise/results/design_result.hpp"

namespace equipoise {

struct SpinUpPoints {
  std::vector<double> times, speeds;  ///< from 0 and the initial speed to the final one
};

/// Coordinates: one speed per point, then for each piece a share of the remaining time.
inline std::size_t coordinates(const SpinUpShape& shape) { return 2 * static_cast<std::size_t>(shape.points) + 1; }

/// Shortest time of the straight way from the initial to the final speed.
double shortest_spin_up(const SpinUpShape& shape);

/// `at`: coordinates(shape) numbers from 0 to 1. Every piece gets the time that its change of speed needs. The rest of
/// `until` is broken like a stick among the pieces and the time after them, uniformly for uniform coordinates. Speeds
/// that need more time than there is are pulled towards the straight way.
SpinUpPoints spin_up_at(const SpinUpShape& shape, std::span<const double> at);

}  // namespace equipoise
