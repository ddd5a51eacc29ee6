// The attractors of a study as text and as JSON.
#pragma once

#include <string>

#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/commands/attractors_result.hpp"

namespace equipoise {

/// A table for the terminal.
std::string attractors_text(const AttractorsResult& result, const TextStyle& style = wide_style);

/// One JSON object. docs/reference/commands/attractors.md lists the keys.
std::string attractors_json(const AttractorsResult& result);

}  // namespace equipoise
