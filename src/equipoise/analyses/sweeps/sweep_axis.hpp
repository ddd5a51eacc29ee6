// Reads the parameters of a sweep as people write them.
#pragma once

#include <string>
#include <vector>

#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

inline constexpr std::size_t most_sweep_axes = 3, most_sweep_cells = 100'000;

/// "KEY=FROM:TO:STEP" or "KEY=A,B,C", in numbers ("speed.final=1.5:6:0.1") or quantities of one unit
/// ("rotor.unbalance=100 g mm:400 g mm:50 g mm"). `option` names it in errors. Throws InputError.
SweepParameter sweep_parameter(const std::string& text, const std::string& option);

/// One axis per text. Zipped: one axis of all texts, which must have equally many values; those of the first must
/// differ, because they identify the cells. Throws InputError for no axis, for too many, and for repeated keys.
std::vector<SweepAxis> sweep_axes(const std::vector<std::string>& texts, bool zip, const std::string& option);

}  // namespace equipoise
