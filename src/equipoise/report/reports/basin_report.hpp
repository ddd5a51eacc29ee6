// The result of an ensemble as text and as JSON.
// This room: each result as text, CSV and JSON.
#pragma once

#include <span>
#include <string>

#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/commands/basin_result.hpp"

namespace equipoise {

/// For the terminal: verdict, shares in percent, the rotor without balls beside that with them.
std::string basin_text(const BasinResult& result, const TextStyle& style = wide_style,
                       std::span<const TriedChange> tried = {});

/// Of a rotor without balls: how many runs tell of it.
std::string bare_words(const BasinResult& result);

/// `tried`: changes for the verdict to tell of. One JSON object; shares are fractions of one.
/// docs/reference/commands/basin.md lists the keys.
std::string basin_json(const BasinResult& result, std::span<const TriedChange> tried = {});

}  // namespace equipoise
