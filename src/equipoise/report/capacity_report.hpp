// Capacities for people and for machines.
#pragma once

#include <string>
#include <vector>

#include "equipoise/drawing/chart.hpp"
#include "equipoise/results/capacity_result.hpp"

namespace equipoise {

/// A line a cell for the terminal.
std::string capacity_text(const CapacityResult& result);

/// One JSON object. docs/guide/command-line.md lists the keys.
std::string capacity_json(const CapacityResult& result);

/// A line a cell, the study before them as comments.
std::string capacity_csv(const CapacityResult& result);

/// Along the first parameter, a line a value of the second, a chart a value of the third; without parameters the
/// balanced share over the values tried.
std::vector<Chart> capacity_charts(const CapacityResult& result);
/// What they show, in a line.
std::string capacity_title(const CapacityResult& result);

}  // namespace equipoise
