// A basin slice: a plane of starts or parameters with the outcome of one start at every pixel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/running/run_info.hpp"
#include "equipoise/results/columns/column.hpp"
#include "equipoise/results/commands/outcome_share.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

inline constexpr int most_slice_pixels = 20000;  ///< along one side

/// A quantity that varies along one side of a basin slice.
struct SliceAxis {
  std::string key;  ///< of rotor, balancer, speed or initial that takes a number; initial.phi_1 for one ball's angle,
                    ///< initial.phi_dot_1 for its rate
  double low = 0.0, high = 1.0;  ///< where the outermost pixels end
  int pixels = 1;

  /// Whether it is a ball's initial angle.
  bool angle() const { return key.starts_with("initial.phi_") && !key.starts_with("initial.phi_dot"); }
  double step() const { return (high - low) / pixels; }
  double centre(int pixel) const { return low + (pixel + 0.5) * step(); }
};

/// phi_ball = phi_of + offset in the initial state; balls count from 1.
struct AngleLink {
  int ball = 2, of = 1;
  double offset = 0.0;
};

/// Marks pixels that a stopped run did not reach.
inline constexpr short not_computed_code = -32768;

/// What a pixel's start came to.
struct SlicePixel {
  short code = not_computed_code;
  float time = std::numeric_limits<float>::quiet_NaN();  ///< study time at which the outcome was known
  float r_max = time;                                    ///< of the final motion
  float balance_margin = time, balance_growth = time;    ///< as in BasinSlice, where they differ between pixels
};

/// The uncertainty exponent between two distances.
struct LocalExponent {
  int from = 1, to = 2;  ///< pixels
  double value = 0.0;
};

/// Each is empty if the slice does not show it: no boundary, or too few pixels. Distances in the plane are in pixels.
struct SliceFigures {
  /// Of the boundary, by box counting: 1 if smooth, 2 if it fills the plane.
  std::optional<Estimate> box_dimension;
  /// The share of pixels with another outcome at distance e grows as e to this power: what more accurate starts gain in
  /// certainty. It is 2 minus the dimension (McDonald, Grebogi, Ott and Yorke, Physica D 17 (1985) 125).
  std::optional<Estimate> uncertainty_exponent;
  /// The same from each distance to the next: where these differ by more than the interval, no one power holds.
  std::vector<LocalExponent> local_exponents;
  /// Mean entropy of outcomes in boxes of 5 x 5 pixels: all, and those with several outcomes. Above log 2 the latter
  /// indicates a fractal boundary (Daza, Wagemakers, Georgeot, Guery-Odelin and Sanjuan, Sci. Rep. 6 (2016) 31416).
  std::optional<Estimate> basin_entropy, boundary_basin_entropy;
  /// For two balls over both angles: largest distance (rad) from balanced angles within which every pixel is balanced.
  std::optional<double> balanced_radius;
  /// Of pixels spread over the slice, those that end elsewhere when followed to `finer` times the tolerance.
  std::optional<Share> flipped;
  static constexpr double finer = 1e-3;
};

/// Rows follow y, pixels within a row x. NaN means no value.
struct BasinSlice : RunInfo {
  Study study;     ///< as given; its values of the two keys play no part
  SliceAxis x, y;  ///< of the pixels that are here
  int every = 1;   ///< of a large slice in a file, only every n-th row and column is here
  std::vector<AngleLink> links;
  std::vector<short> code;
  std::vector<float> time;   ///< study time at which the outcome was known
  std::vector<float> r_max;  ///< of the final motion
  /// lambda + sum mu_i - 2 max(lambda, mu_i): a balanced state exists where >= 0. One value if all pixels share a
  /// rotor.
  std::vector<float> balance_margin;
  /// Largest real part of an eigenvalue at the more stable of the isolated balanced states; not a number where there
  /// are none. One value where all pixels share a rotor.
  std::vector<float> balance_growth;
  /// Attractors by identifier, then undecided, diverged, failed: of the whole map. Shares are of the computed pixels,
  /// which form a grid: their intervals describe random ones. Pixels of measure zero (pixels_left_out) do not count.
  std::vector<OutcomeShare> codes;
  SliceFigures figures;  ///< of the whole map, if it is complete
  bool complete = true;
  bool read_whole = false;                        ///< nothing was computed: the output held everything
  std::uint64_t pixels = 0, pixels_computed = 0;  ///< of the whole map
  std::uint64_t pixels_left_out = 0;              ///< of shares and figures: analyses/basin_slices/start_pixels.hpp
  /// Every pixel starts some alike balls in one place, which pixels_left_out does not count.
  bool balls_together = false;
  std::uint64_t pixels_kept = 0;  ///< computed pixels that earlier runs left in the output

  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(x.pixels) + static_cast<std::size_t>(column);
  }
};

/// The numbers of a pixel, as files name them.
struct PixelNumber : Column {
  float SlicePixel::*value;
  std::vector<float> BasinSlice::*all;  ///< of every pixel, or of the rotor
  bool of_rotor;                        ///< the same at all pixels that share a rotor
};
inline constexpr std::array<PixelNumber, 4> pixel_numbers{{
    {{"decision_time", "study time at which the outcome was known", study::Dimension::time},
     &SlicePixel::time,
     &BasinSlice::time,
     false},
    {{"r_max", "largest distance of the rotor's centre from the axis on the final motion", study::Dimension::length},
     &SlicePixel::r_max,
     &BasinSlice::r_max,
     false},
    {{"balance_margin", "lambda + sum mu_i - 2 max(lambda, mu_i): a balanced state exists where this is 0 or more"},
     &SlicePixel::balance_margin,
     &BasinSlice::balance_margin,
     true},
    {{"balance_growth", "largest real part of an eigenvalue at the balanced state", study::Dimension::speed,
      "stable where negative"},
     &SlicePixel::balance_growth,
     &BasinSlice::balance_growth,
     true},
}};
/// visit(k, number) for those that differ from pixel to pixel.
template <class Visit>
void visit_pixel_numbers(bool one_rotor, const Visit& visit) {
  for (std::size_t k = 0; k < pixel_numbers.size(); ++k)
    if (!one_rotor || !pixel_numbers[k].of_rotor) visit(k, pixel_numbers[k]);
}

/// Whether every pixel draws its own start, by its number (row by row from 0) and the study's seed: if both axes are
/// parameters and the study does not say where the balls start. One start for all would represent no other.
bool draws_starts(const BasinSlice& map);

/// The axis of every `every`-th pixel of another; their centres stay in place.
SliceAxis thinned(const SliceAxis& axis, int every);
/// The first of these pixels.
inline int first_of(int every) { return every / 2; }

/// Keeps rows and columns at even distances, so that at most `most` are left along either side.
BasinSlice thinned(const BasinSlice& map, int most);

}  // namespace equipoise
