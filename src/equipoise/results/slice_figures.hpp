// How the basins of a map lie in each other, as numbers.
#pragma once

#include <optional>

namespace equipoise {

/// With a 95 % interval.
struct SliceFigure {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// Each empty where the map does not show it: no boundary, or too few pixels. Distances in the plane are in pixels.
struct SliceFigures {
  /// Of the boundary, by counting the boxes that it passes through: 1 if smooth, 2 if it fills the plane.
  std::optional<SliceFigure> box_dimension;
  /// Share of pixels that have another outcome at a distance e goes as e to this power: the gain in certainty by more
  /// exact starts; 2 less the dimension (McDonald, Grebogi, Ott and Yorke, Physica D 17 (1985) 125).
  std::optional<SliceFigure> uncertainty_exponent;
  /// Mean entropy of outcomes in boxes of 5 x 5 pixels, of all and of those with more than one outcome; above log 2 the
  /// latter tells a fractal boundary (Daza, Wagemakers, Georgeot, Guery-Odelin and Sanjuan, Sci. Rep. 6 (2016) 31416).
  std::optional<SliceFigure> basin_entropy, boundary_basin_entropy;
  /// Two balls over both their angles: largest distance in rad from balanced angles at which every pixel is balanced.
  std::optional<double> balanced_radius;
};

}  // namespace equipoise
