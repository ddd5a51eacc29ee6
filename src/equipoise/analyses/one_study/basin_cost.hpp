// Estimates the cost of basin() by running a part of it.
#pragma once

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/commands/explanation.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The longest wall time of measure_cost() by default, in seconds.
inline constexpr double cost_patience = 10.0;

/// Runs the search as basin() does, then the first starts until their mean cost is known well enough, all on one
/// thread. Cuts off after `patience` seconds or when stopped. Throws InputError for studies that basin() would not
/// decide.
BasinCost measure_cost(const Study& study, const RunOptions& options, double patience = cost_patience);

}  // namespace equipoise
