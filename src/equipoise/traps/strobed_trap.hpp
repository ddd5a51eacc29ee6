// Traps around the periodic orbits of rotors with anisotropic supports or gravity: level sets of a quadratic form that
// turns with the rotor. The rotor's angle tells the phase, so no clock among the balls is needed (cf. orbit_trap.hpp).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/model/parameters.hpp"
#include "equipoise/motions/motion.hpp"
#include "equipoise/orbits/balanced_continuum.hpp"

namespace equipoise {

/// A table over the orbit's period: `strobes` times `cells` cells and the first node once more. Deviations are in
/// state_scale().
struct StrobedTrap {
  int attractor = 0;
  int strobes = 1, cells = 1;
  std::vector<Eigen::VectorXd> states, rates;  ///< on the orbit, angles unwrapped; dz/dt
  std::vector<Eigen::MatrixXd> forms;          ///< P: V = d^T P d
  double level = 0.0;                          ///< inside: V < level
};

/// The trap of a stable periodic orbit (or of a balanced equilibrium of anisotropic supports), its level still 0:
/// V = integral of |d|^2 e^{2 a t} along the linear flow, a = 0.8 of the slowest rate, so that V falls at least as
/// e^{-2 a t}. Scaled so that V = 1 lies within |d| < 1. Empty for unstable motions and failed integrations.
std::optional<StrobedTrap> strobed_trap(const model::Parameters& p, double speed, const Motion& motion, int attractor);

/// Smallest V of a state, when the rotor's angle is psi, over the phases that the angle leaves open, or infinity if it
/// is plain that all are above the trap's level; equal balls take the places of those on the orbit that they are
/// nearest to.
double strobed_value(const model::Parameters& p, double speed, const StrobedTrap& trap, const double* state,
                     double psi);

/// A state on the level `level` where row `row` of the table begins: `direction` is a unit vector.
Eigen::VectorXd strobed_trap_state(const model::Parameters& p, const StrobedTrap& trap, int row, double level,
                                   const Eigen::VectorXd& direction);

/// Slowest rate at which deviations from the orbit die out, negative if it is stable.
double slowest_strobed_rate(const Motion& motion);

using StrobedFamilyTest = std::function<bool(const double* state, double psi)>;

/// Capture by a continuum of balanced states, or by what gravity leaves of it, asked at any angle `psi`.
StrobedFamilyTest strobed_family_test(const model::Parameters& p, double speed, ContinuumTrap trap);

/// What DecisionRule::strobed asks: all of these traps, and the continuum if there is one.
StrobedTraps traps_as_rule(const model::Parameters& p, double speed,
                           const std::vector<std::shared_ptr<const StrobedTrap>>& traps,
                           const StrobedFamilyTest& family);

}  // namespace equipoise
