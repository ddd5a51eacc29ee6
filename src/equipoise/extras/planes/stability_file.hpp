// Where balance is stable in a plane, as NetCDF.
#pragma once

#include <string>

#include "equipoise/extras/planes/stability_plane.hpp"

namespace equipoise {

/// Throws InputError unless `path` can be written and is new or holds the same plane of the same study, whole or not.
void check_stability_file(const std::string& path, const StabilityPlane& plane);

/// Writes `path` anew: dimensions y and x with their coordinates, variables of point_numbers(y, x), every one with
/// units and long_name; study and version as attributes; a checksum. Throws RunError if it cannot be written.
void write_stability_file(const std::string& path, const StabilityPlane& plane);

}  // namespace equipoise
