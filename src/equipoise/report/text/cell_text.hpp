// Parameters of sweeps and similar results in tables.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

/// "unbalance, g mm": the title of a key's column.
std::string column_title(const std::string& key, const std::string& unit);
/// The columns of all parameters: titles in words, and values in a cell.
std::vector<std::string> parameter_titles(const std::vector<SweepAxis>& axes);
std::vector<DocumentCell> parameter_values(const std::vector<SweepAxis>& axes, std::size_t cell);

/// The same in CSV, each with a comma behind it.
std::string csv_titles(const std::vector<SweepAxis>& axes);
std::string csv_values(const std::vector<SweepAxis>& axes, std::size_t cell);
/// "rotor.unbalance (g mm)".
std::string csv_title(const std::string& key, const std::string& unit);

/// The parameters with their values, and a cell's values by key.
Json over_json(const std::vector<SweepAxis>& axes);
Json at_json(const std::vector<SweepAxis>& axes, std::size_t cell);

}  // namespace equipoise
