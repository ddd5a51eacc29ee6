// A stretch of a steady motion, for a drawing of it.
#pragma once

#include "equipoise/results/machine_page.hpp"
#include "equipoise/results/trajectory.hpp"
#include "equipoise/running/run_options.hpp"
#include "equipoise/types/motion.hpp"

namespace equipoise {

/// How long one turn of the rotor takes; of one that hardly turns, a long time.
double turn_time(double speed);
/// How long a motion is to be looked at until all of it has been seen: a period and some turns, or, of what never
/// repeats itself, a long time.
double whole_way(const Motion& motion);

/// `count` + 1 states over `duration` > 0, from motion.state on; fewer if the integration fails or is stopped.
MotionPath motion_path(const model::System& system, const Motion& motion, double duration, int count,
                       const RunOptions& options = {});

/// The same of a trajectory, from its time number `first` on.
MotionPath motion_path(const model::Parameters& p, const Trajectory& trajectory, std::size_t first);

}  // namespace equipoise
