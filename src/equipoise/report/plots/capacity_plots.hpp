// Capacities as plots.
#pragma once

#include <string>
#include <vector>

#include "equipoise/report/drawing/plot.hpp"
#include "equipoise/results/commands/capacity_result.hpp"

namespace equipoise {

/// Along the first parameter, one line per value of the second and one plot per value of the third. Without
/// parameters: the balanced share over the values tried.
std::vector<Plot> capacity_plots(const CapacityResult& result);
/// A one-line title for the plots.
std::string capacity_title(const CapacityResult& result);

}  // namespace equipoise
