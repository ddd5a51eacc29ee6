// Capacities as charts.
#pragma once

#include <string>
#include <vector>

#include "equipoise/drawing/chart.hpp"
#include "equipoise/results/capacity_result.hpp"

namespace equipoise {

/// Along the first parameter, a line a value of the second, a chart a value of the third; without parameters the
/// balanced share over the values tried.
std::vector<Chart> capacity_charts(const CapacityResult& result);
/// What they show, in a line.
std::string capacity_title(const CapacityResult& result);

}  // namespace equipoise
