// The arrays of an ensemble's starts, filled as the starts are counted.
#pragma once

#include "equipoise/results/start_arrays.hpp"
#include "equipoise/sampling/sampling.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

/// Adds the next start, which began as `start` and came to `fate`; `own`: it is the caller's; `row`: its transients, if
/// any. What else it drew is made again: starts are functions of their index.
void add_start(const Study& study, const Sampler& sampler, const InitialState& start, bool own, const Fate& fate,
               const TransientRow* row, StartArrays& arrays);

/// Dry friction may hold balls of the study, or of what its starts draw.
bool balls_may_stick(const Study& study);

}  // namespace equipoise
