// Where balance is stable, at every point of a plane of two parameters.
// This room: rates near balance over a plane of two parameters.
#pragma once

#include <string>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/extras/planes/stability_plane.hpp"

namespace equipoise {

class PlaneStudies;

/// Progress is in points.
struct StabilitySettings : RunOptions {
  SliceAxis x, y;
  std::string output;  ///< NetCDF, written at the end; an existing file must hold the same plane. Empty: none
};

/// By eigenvalues alone; uncertain values are at their medians. The result depends on the study and the axes only.
/// Throws InputError for a study without balls, for keys, ranges and values that make no valid study, and for an output
/// with other content.
StabilityPlane stability(const Study& study, const StabilitySettings& settings);
/// Over these studies, of a study with balls and nothing uncertain.
StabilityPlane stability(const PlaneStudies& studies, const RunOptions& options);

}  // namespace equipoise
