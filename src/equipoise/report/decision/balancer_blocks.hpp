// What the balls of an ensemble are good for, as tables and sentences.
#pragma once

#include <vector>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/results/commands/basin_result.hpp"

namespace equipoise {

/// In groups: the rotor without balls beside that with them; which limits are kept; what standards make of it. A group
/// that has nothing to tell is left out.
std::vector<std::vector<Block>> balancer_blocks(const BasinResult& result);

}  // namespace equipoise
