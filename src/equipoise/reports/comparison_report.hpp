// A comparison for people and for machines.
#pragma once

#include <string>

#include "equipoise/results/comparison_result.hpp"

namespace equipoise {

/// Shares, differences, changes and a verdict for the terminal.
std::string comparison_text(const ComparisonResult& result);

/// What the difference in balanced starts amounts to, in one sentence.
std::string verdict(const ComparisonResult& result);

/// One JSON object. docs/guide/command-line.md lists the keys.
std::string comparison_json(const ComparisonResult& result);

}  // namespace equipoise
