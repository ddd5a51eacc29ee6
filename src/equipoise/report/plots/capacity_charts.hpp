// Capacities as charts.
#pragma once

#include <string>
#include <vector>

#include "equipoise/report/drawing/chart.hpp"
#include "equipoise/results/commands/capacity_result.hpp"

namespace equipoise {

/// Along the first parameter, one line per value of the second and one chart per value of the third. Without
/// parameters: the balanced share over the values tried.
std::vector<Chart> capacity_charts(const CapacityResult& result);
/// A one-line title for the charts.
std::string capacity_title(const CapacityResult& result);

}  // namespace equipoise
