// A stretch of a steady motion, for a drawing of it.
#pragma once

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/commands/machine_page.hpp"
#include "equipoise/results/commands/trajectory.hpp"
#include "equipoise/results/types/motion.hpp"

namespace equipoise {

/// Duration of one turn of the rotor; long if it hardly turns.
double turn_time(double speed);
/// How long to look at a motion to see all of it: a period and some turns, or a long time if it never repeats.
double whole_way(const Motion& motion);

/// `count` + 1 states over `duration` > 0 from motion.state on; fewer if the integration fails or is stopped. `place`:
/// along the shaft of a tilting rotor, whose path is wanted.
MotionPath motion_path(const model::System& system, const Motion& motion, double duration, int count,
                       const RunOptions& options = {}, double place = 0.0);

/// The same for a trajectory, from its row `first` on.
MotionPath motion_path(const model::Parameters& p, const Trajectory& trajectory, std::size_t first, double place = 0.0);

}  // namespace equipoise
