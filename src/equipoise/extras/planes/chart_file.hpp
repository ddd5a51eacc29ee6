// Curves in a plane of two parameters, as NetCDF.
#pragma once

#include <string>

#include "equipoise/extras/planes/bifurcation_chart.hpp"

namespace equipoise {

/// Throws InputError unless `path` can be written and is new or holds the chart of the same plane and study.
void check_chart_file(const std::string& path, const BifurcationChart& chart);

/// Writes `path` anew: points of all curves one after the other, with the number of their curve; special points;
/// boxes. Throws RunError if it cannot be written.
void write_chart_file(const std::string& path, const BifurcationChart& chart);

}  // namespace equipoise
