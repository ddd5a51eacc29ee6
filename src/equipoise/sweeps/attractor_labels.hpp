// Identifiers that mean the same motion in all cells of a sweep.
#pragma once

#include <optional>
#include <vector>

#include "equipoise/results/sweep_result.hpp"

namespace equipoise {

/// Motions with an identifier of their own have it in every cell. The others are matched with those of the neighbouring
/// cells before, along every axis: one of the same kind and kind of name that shakes and drifts most nearly as much,
/// if no more than a third less or more. What matches nothing gets the next free identifier, numbered behind its name
/// if that is taken.
void label_attractors(const std::vector<SweepAxis>& axes, SweepCells& cells);

}  // namespace equipoise
