// A comparison as text and as JSON.
#pragma once

#include <string>

#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/commands/comparison_result.hpp"

namespace equipoise {

/// Shares, differences, changes and a verdict for the terminal.
std::string comparison_text(const ComparisonResult& result, const TextStyle& style = wide_style);

/// The difference in balanced starts, in one sentence.
std::string verdict(const ComparisonResult& result);

/// One JSON object. docs/reference/commands/compare.md lists the keys.
std::string comparison_json(const ComparisonResult& result);

}  // namespace equipoise
