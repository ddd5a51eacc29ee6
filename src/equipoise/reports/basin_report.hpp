// The result of an ensemble as text and as JSON.
#pragma once

#include <string>

#include "equipoise/results/basin_result.hpp"

namespace equipoise {

/// A table for the terminal; shares in percent.
std::string basin_text(const BasinResult& result);

/// Of a rotor without balls: how many runs tell of it.
std::string bare_words(const BasinResult& result);

/// One JSON object; shares are fractions of one. docs/guide/command-line.md lists the keys.
std::string basin_json(const BasinResult& result);

}  // namespace equipoise
