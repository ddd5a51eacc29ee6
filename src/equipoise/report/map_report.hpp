// A map for people and for machines.
#pragma once

#include <string>

#include "equipoise/results/plane_map.hpp"

namespace equipoise {

/// Shares and figures for the terminal.
std::string map_text(const PlaneMap& map);

/// One JSON object. docs/guide/command-line.md lists the keys.
std::string map_json(const PlaneMap& map);

}  // namespace equipoise
