// Where balance is stable in a plane, as NetCDF.
#pragma once

#include <string>

#include "equipoise/extras/planes/stability_plane.hpp"
#include "equipoise/results/columns/dataset.hpp"

namespace equipoise {

/// What is said of any file over a plane: all that determines its content, under the attribute `name`.
struct PlaneIdentity {
  PlaneIdentity(const char* name, const Study& study, const StabilityPlane& plane);

  /// Throws InputError unless `path` can be written and is new or has the same identity. `none`: what a file without it
  /// holds not; `allowed`: what it must be; `results`: what this is.
  void require_at(const std::string& path, const std::string& none, const std::string& allowed,
                  const std::string& results) const;
  /// Attributes: the identity, keys and ranges.
  void say(Dataset& data, const StabilityPlane& plane) const;

  const char* name;
  std::string text;
};

/// Throws InputError unless `path` can be written and is new or holds the same plane of the same study, whole or not.
void check_stability_file(const std::string& path, const StabilityPlane& plane);

/// Writes `path` anew: dimensions y and x with their coordinates, variables of point_numbers(y, x), every one with
/// units and long_name; study and version as attributes; a checksum. Throws RunError if it cannot be written.
void write_stability_file(const std::string& path, const StabilityPlane& plane);

}  // namespace equipoise
