// Where balance is stable, at every point of a plane of two parameters.
#pragma once

#include <cstdint>
#include <string>

#include "equipoise/planes/stability_plane.hpp"
#include "equipoise/running/run_options.hpp"

namespace equipoise {

inline constexpr std::uint64_t most_stability_points = std::uint64_t{1} << 24;

/// Progress is in points.
struct StabilitySettings : RunOptions {
  SliceAxis x, y;
  std::string output;  ///< NetCDF, written at the end; an existing file must hold the same plane. Empty: none
};

/// By eigenvalues alone; uncertain values are at their medians. The result depends on the study and the axes only.
/// Throws InputError for a study without balls, for keys, ranges and values that make no valid study, and for an output
/// with other content.
StabilityPlane stability(const Study& study, const StabilitySettings& settings);

}  // namespace equipoise
