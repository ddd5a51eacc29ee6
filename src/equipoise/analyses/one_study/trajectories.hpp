// Trajectories from many starts of one study.
#pragma once

#include <span>
#include <vector>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/commands/trajectory.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// As simulate() with each start in place of study.initial, to the same tolerance. A smooth rotor at a prescribed speed
/// is followed on SIMD lanes; one with a motor, touching or sticking balls, or a tilt and held balls, start by start
/// on all threads. A run depends neither on the other starts nor on the threads. Progress is in trajectories. Throws
/// InputError for times out of order, unusable starts (check_given_starts()) and an invalid study.
Trajectories simulate(const Study& study, std::span<const InitialState> starts, const std::vector<double>& times,
                      const RunOptions& options = {});

/// Those of basin().
std::vector<InitialState> drawn_starts(const Study& study);

}  // namespace equipoise
