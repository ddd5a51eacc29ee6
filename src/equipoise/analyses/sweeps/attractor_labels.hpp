// Identifiers that mean the same motion in all cells of a sweep.
#pragma once

#include <optional>
#include <vector>

#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

/// Motions with a fixed identifier keep it in every cell. The others are matched with those of the preceding neighbours
/// along every axis: the most similar in vibration and drift of the same kind and kind of name, if they differ by at
/// most a third. An unmatched motion gets the next free identifier, and a number if its name is taken.
void label_attractors(const std::vector<SweepAxis>& axes, SweepCells& cells);

}  // namespace equipoise
