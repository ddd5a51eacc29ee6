// Capacities as text, JSON and CSV.
#pragma once

#include <string>

#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/commands/capacity_result.hpp"

namespace equipoise {

/// A line a cell for the terminal.
std::string capacity_text(const CapacityResult& result, const TextStyle& style = wide_style);

/// One JSON object. docs/reference/commands/sweep.md lists the keys.
std::string capacity_json(const CapacityResult& result);

/// One line per cell, after the study as comments.
std::string capacity_csv(const CapacityResult& result);

}  // namespace equipoise
