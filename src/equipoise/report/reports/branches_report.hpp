// Attractors along a parameter as text, JSON and CSV.
#pragma once

#include <string>

#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/commands/branches_result.hpp"

namespace equipoise {

/// Tables of branches and events for the terminal.
std::string branches_text(const BranchesResult& result, const TextStyle& style = wide_style);

/// One JSON object. docs/reference/commands/attractors.md lists the keys.
std::string branches_json(const BranchesResult& result);

/// One line per value and branch, after comment lines with the study and the version.
std::string branches_csv(const BranchesResult& result);

}  // namespace equipoise
