// The parameters of a sweep as people write them.
#pragma once

#include <string>
#include <vector>

#include "equipoise/results/sweep_result.hpp"

namespace equipoise {

inline constexpr std::size_t most_sweep_axes = 3, most_sweep_cells = 100'000;

/// "KEY=FROM:TO:STEP" or "KEY=A,B,C", in numbers ("speed.final=1.5:6:0.1") or quantities of one unit
/// ("rotor.unbalance=100 g mm:400 g mm:50 g mm"). `option` names it in errors. Throws InputError.
SweepParameter sweep_parameter(const std::string& text, const std::string& option);

/// One axis a text; zipped: one axis of all, which must have as many values each, the first different ones, by which
/// cells are told apart. Throws InputError for none, for too many, and for keys that are named twice.
std::vector<SweepAxis> sweep_axes(const std::vector<std::string>& texts, bool zip, const std::string& option);

}  // namespace equipoise
