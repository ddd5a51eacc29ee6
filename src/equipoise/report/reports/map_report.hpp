// A basin slice as text and as JSON.
#pragma once

#include <string>

#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// Shares and figures for the terminal.
std::string map_text(const BasinSlice& map, const TextStyle& style = wide_style);

/// One JSON object. docs/reference/commands/map.md lists the keys.
std::string map_json(const BasinSlice& map);

}  // namespace equipoise
