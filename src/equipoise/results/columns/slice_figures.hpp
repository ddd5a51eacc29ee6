// Numbers that describe how the basins in a slice are interwoven.
#pragma once

#include <optional>
#include <vector>

namespace equipoise {

/// With a 95 % interval.
struct SliceFigure {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// The uncertainty exponent between two distances.
struct LocalExponent {
  int from = 1, to = 2;  ///< pixels
  double value = 0.0;
};

/// Each is empty if the slice does not show it: no boundary, or too few pixels. Distances in the plane are in pixels.
struct SliceFigures {
  /// Of the boundary, by box counting: 1 if smooth, 2 if it fills the plane.
  std::optional<SliceFigure> box_dimension;
  /// The share of pixels with another outcome at distance e grows as e to this power: what more accurate starts gain in
  /// certainty. It is 2 minus the dimension (McDonald, Grebogi, Ott and Yorke, Physica D 17 (1985) 125).
  std::optional<SliceFigure> uncertainty_exponent;
  /// The same from each distance to the next: where these differ by more than the interval, no one power holds.
  std::vector<LocalExponent> local_exponents;
  /// Mean entropy of outcomes in boxes of 5 x 5 pixels: all, and those with several outcomes. Above log 2 the latter
  /// indicates a fractal boundary (Daza, Wagemakers, Georgeot, Guery-Odelin and Sanjuan, Sci. Rep. 6 (2016) 31416).
  std::optional<SliceFigure> basin_entropy, boundary_basin_entropy;
  /// For two balls over both angles: largest distance (rad) from balanced angles within which every pixel is balanced.
  std::optional<double> balanced_radius;
};

}  // namespace equipoise
