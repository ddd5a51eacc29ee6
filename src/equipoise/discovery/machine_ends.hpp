// Ends of motion that are no single attractor: of rotors that coast, and of balls that dry friction holds.
#pragma once

#include <memory>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/deciding/trap_set.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/motions/catalogue.hpp"
#include "equipoise/traps/coasting_trap.hpp"

namespace equipoise {

/// A rotor that no torque drives has stalled, the attractor `stalled`, or keeps its speed in balance.
Traps ends_of_coasting(std::shared_ptr<const CoastingTrap> trap, int stalled, const StopFlag* stop);
/// All balls are held for good where they stick; which of `listed` that is, its catalogue says.
Traps stuck_balls(const model::System& system, const Catalogue& listed);

}  // namespace equipoise
