// Traps around stable periodic orbits, in Floquet coordinates over the angle of a steadily turning ball.
#pragma once

#include <vector>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/motions/motion.hpp"

namespace equipoise {

/// A trap around each exchange copy of a stable periodic motion, all with level 1; to be scaled by set_level() once a
/// level has been validated. Empty where none can be made: no ball turns steadily along the orbit, more than 24 copies,
/// an orbit of more than 16 turns, or Floquet vectors that double precision cannot separate.
std::vector<OrbitTrap> orbit_traps(const model::Parameters& p, double speed, const Motion& motion, int attractor);

/// Sets the level and, from it, the bounds on r and ball rates.
void set_level(OrbitTrap& trap, int balls, double level);

/// |F d|^2 at `state`: inside the trap if below its level.
double trap_value(const OrbitTrap& trap, int balls, const double* state);
/// V at `state` for a balanced trap.
double trap_value(const BalancedTrap& trap, int balls, const double* state);

/// The state that sits in row `row` of the table, plus the deviation d with F d = `direction` (dimension - 1 numbers).
void trap_state(const OrbitTrap& trap, int balls, int row, const double* direction, double* state);

}  // namespace equipoise
