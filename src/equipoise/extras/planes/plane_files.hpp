// Planes of stability and charts as NetCDF.
#pragma once

#include <string>

#include "equipoise/extras/planes/bifurcation_chart.hpp"

namespace equipoise {

/// Throws InputError unless `path` can be written and is new or holds the same plane of the same study, whole or not.
void check_stability_file(const std::string& path, const StabilityPlane& plane);
void check_chart_file(const std::string& path, const BifurcationChart& chart);

/// Writes `path` anew: dimensions y and x with their coordinates, variables of point_numbers(y, x), every one with
/// units and long_name; study and version as attributes; a checksum. Throws RunError if it cannot be written.
void write_stability_file(const std::string& path, const StabilityPlane& plane);
/// Likewise: points of all curves one after the other, with the number of their curve; special points; regions; boxes.
void write_chart_file(const std::string& path, const BifurcationChart& chart);

}  // namespace equipoise
