// One trajectory at stated times.
// This room: one trajectory at stated times; equations for other integrators.
#pragma once

#include <vector>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/commands/trajectory.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Samples `study` by dense output at `times` (increasing, >= 0). The tolerance is study.numerics.tolerance, else
/// default_simulate_tolerance, per step, relative to each variable's size. Progress is in rows. One thread does
/// everything; no CPU target is chosen. Throws InputError for times out of order or an invalid study.
Trajectory simulate(const Study& study, const std::vector<double>& times, const RunOptions& options = {});

}  // namespace equipoise
