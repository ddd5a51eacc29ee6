// Basin slices: the outcome of one start at every pixel of a plane of two quantities.
// This room: maps: one start at every pixel.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/commands/basin_slice.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

inline constexpr std::uint64_t most_pixels_in_memory = std::uint64_t{1} << 24;  ///< for a slice without a file
inline constexpr int most_held_side = 2048;  ///< pixels along a side of what basin_slice() returns of larger slices

/// Progress is in pixels.
struct BasinSliceSettings : RunOptions {
  SliceAxis x, y;
  std::vector<AngleLink> links;  ///< applied in order, after the axes
  /// Pixels are kept in this file as they become known. Another call of the same slice continues from it, or reads a
  /// complete slice from it. Empty: none.
  std::string output;
};

/// Follows the start [initial] of `study` with the pixel's two values; with draws_starts() each pixel follows its own
/// start. Over two initial values pixels are decided as basin() decides its starts, else as it decides those of a study
/// with uncertain values, within numerics.horizon (unset: 3000) after the last piece begins. Codes are the identifiers
/// of the catalogue. Motions without a fixed identifier get the next codes, one per name: names usual in slices always
/// the same ones, others in the order of pixels. The slice depends only on the study, the axes and the links. Memory is
/// bounded: of a slice with more than most_pixels_in_memory pixels the output has all, and the result some
/// (BasinSlice::every). Throws InputError for keys, links and values that make no valid study, studies that cannot be
/// decided, and files with other content.
BasinSlice basin_slice(const Study& study, const BasinSliceSettings& settings);

}  // namespace equipoise
