// A stretch of a steady motion, for a drawing of it.
#pragma once

#include "equipoise/motions/motion.hpp"
#include "equipoise/results/machine_page.hpp"
#include "equipoise/results/trajectory.hpp"

namespace equipoise {

/// `count` + 1 states over `duration` > 0, from motion.state on; fewer if the integration fails.
MotionPath motion_path(const model::System& system, const Motion& motion, double duration, int count);

/// The same of a trajectory, from its time number `first` on.
MotionPath motion_path(const model::Parameters& p, const Trajectory& trajectory, std::size_t first);

}  // namespace equipoise
