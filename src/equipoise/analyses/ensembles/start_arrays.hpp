// The arrays of an ensemble's starts, filled as the starts are counted.
#pragma once

#include "equipoise/results/commands/start_arrays.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {

/// Adds start `index`, which began as `start` and has `outcome`. `own`: the caller gave it. `row`: its transients, or
/// null. Its other draws are made again: they are functions of its index.
void add_start(const Study& study, const Sampler& sampler, std::uint64_t index, const InitialState& start, bool own,
               const Outcome& outcome, const TransientRow* row, StartArrays& arrays);

/// Whether dry friction may hold balls, in the study or for values that its starts may draw.
bool balls_may_stick(const Study& study);

}  // namespace equipoise
