// Spin-ups as points of a cube, all within the limits on speed and slope.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace equipoise {

/// A spin-up free between two speeds, piecewise linear over `points` points, then constant; in the design's units.
struct SpinUpShape {
  int points = 1;
  double until = 0.0;            ///< latest time at which the final speed is reached
  double low = 0.0, high = 0.0;  ///< of the points' speeds
  std::optional<double> slope;   ///< largest change of speed per time
  double initial = 0.0, final = 0.0;
  std::string time_unit;
  std::optional<std::string> law;  ///< speed.law, if the study states it

  /// Of the shortest piece.
  double least_duration() const { return 1e-3 * until; }
};

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
