// What basin() of a study costs, measured on a piece of it.
#pragma once

#include "equipoise/results/explanation.hpp"
#include "equipoise/running/run_options.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// The clock's time that measure_cost() takes at most, where nobody says otherwise.
inline constexpr double cost_patience = 10.0;

/// The search as basin() makes it, and the first starts by what it found, until their mean is known well enough; on one
/// thread. What is not done after `patience` seconds, or once stopped, is cut off. Throws InputError for studies that
/// basin() would not decide.
BasinCost measure_cost(const Study& study, const RunOptions& options, double patience = cost_patience);

}  // namespace equipoise
