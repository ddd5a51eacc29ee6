// Capacities as text, JSON and CSV.
#pragma once

#include <string>

#include "equipoise/results/capacity_result.hpp"

namespace equipoise {

/// "213", "above 400", "below 20".
std::string capacity_value_text(const CapacityResult& result, const CapacityCell& cell);

/// One line per cell, for the terminal.
std::string capacity_text(const CapacityResult& result);

/// One JSON object. docs/guide/command-line.md lists the keys.
std::string capacity_json(const CapacityResult& result);

/// One line per cell, after the study as comments.
std::string capacity_csv(const CapacityResult& result);

}  // namespace equipoise
