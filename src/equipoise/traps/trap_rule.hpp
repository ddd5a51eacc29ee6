// What lanes ask of the traps around motions and continua.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/motions/catalogue.hpp"
#include "equipoise/traps/continuum_trap.hpp"
#include "equipoise/traps/cycle_trap.hpp"
#include "equipoise/traps/stalled_trap.hpp"

namespace equipoise {

using CycleTraps = std::vector<std::shared_ptr<const CycleTrap>>;

/// Makes `rule` ask all of these, and the continuum if there is one, in place of what it asked before of the kind: at
/// every step where nothing depends on the rotor's angle, else, and of a continuum around a race off its centre, one
/// state at a time and with that angle, where half a window ends. Traps of balanced states stay as they are.
void set_traps(DecisionRule& rule, const model::System& system, const CycleTraps& cycles,
               const std::optional<ContinuumTrap>& continuum, const std::optional<StalledTrap>& stalled = {});

/// Dry friction holds all balls for good where they stick; which of `listed` that is, its catalogue says.
Traps stuck_balls(const model::System& system, const Catalogue& listed);

}  // namespace equipoise
