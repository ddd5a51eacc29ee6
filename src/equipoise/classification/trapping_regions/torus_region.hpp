// Trapping regions around attracting tori: the distance of a state from a cloud of states on the torus.
#pragma once

#include <memory>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/classification/trapping_regions/window_region.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// The trapping region around an attracting torus of a smooth system with section `none`, its level found by trials.
/// Null if there is none. `near`: as in highest_good_level().
std::shared_ptr<const WindowRegion> torus_region(const model::System& system, const Motion& motion, int attractor,
                                                 const TrialSettings& settings, double near = 0.0);

}  // namespace equipoise
