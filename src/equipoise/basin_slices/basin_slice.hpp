// Maps: the outcome of one start at every pixel of a plane of two quantities.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/results/basin_slice.hpp"
#include "equipoise/running/run_options.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

inline constexpr std::uint64_t most_pixels_in_memory = std::uint64_t{1} << 24;  ///< of a map without a file
inline constexpr int most_held_side = 2048;  ///< pixels along a side of what basin_slice() returns of larger maps
inline constexpr int largest_map_block = 64;

/// Progress is in pixels.
struct BasinSliceSettings : RunOptions {
  SliceAxis x, y;
  std::vector<AngleLink> links;  ///< applied in order, after the axes
  /// Not 0: edges of blocks of so many pixels (a power of two from 2) are computed first, and what is within edges of
  /// one outcome is filled in; other blocks are divided until single pixels are left (basin_slices/pixel_plan.hpp).
  int block = 0;
  /// Pixels are kept in this file as they are known, from which another call of the same map goes on; a whole map is
  /// read from it. Empty: none.
  std::string output;
  /// A finished map of the same study over the same keys, whose computed pixels with the same centres, to rounding, are
  /// taken over. Empty: none.
  std::string from;
};

/// Follows the start [initial] of `study`, with the pixel's two values; where draws_starts() one of its own. Over two
/// initial values pixels are
/// decided as basin() decides its starts, else as it decides those of a study with uncertain values, within
/// numerics.horizon (unset: 3000) after the last branch begins. Codes are the identifiers of the catalogue; motions
/// without one of their own get the next ones, one a name: those usual in maps the same ones everywhere, others in the
/// order of pixels. The map depends on the study, the axes and the blocks alone. Memory is bounded: of a map of more
/// than most_pixels_in_memory pixels all are in the output, and the answer holds some of them (BasinSlice::every).
/// Throws InputError for keys, links and values that make no study, studies that cannot be decided, and files that hold
/// something else.
BasinSlice basin_slice(const Study& study, const BasinSliceSettings& settings);

}  // namespace equipoise
