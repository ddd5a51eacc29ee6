// How far a trap can be widened: levels from whose edge every one of thousands of tried states comes to the attractor.
#pragma once

#include "equipoise/attractors/decision_rule.hpp"
#include "equipoise/attractors/strobed_trap.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// What the tries share.
struct TrialSettings {
  const model::Parameters* parameters = nullptr;
  double speed = 0.0;
  double tolerance = 1e-6;
  int threads = 1;
  const StopFlag* stop = nullptr;
};

/// Widens `trap`, whose level must be one inside which V decreases, by a factor of at most 64, and so that twice the
/// level lies within half a turn of any ball: to a quarter of `nearest_foreign`, the smallest V on any pilot trajectory
/// that ended elsewhere, or further, to where all of 4096 states on twice the level come to balance.
void widen(BalancedTrap& trap, const TrialSettings& settings, double slowest_rate, double nearest_foreign);

/// Sets the level and with it the reach.
void set_level(BalancedTrap& trap, double level);

/// Sets the level of an orbit's trap, and of its exchange copies alike: half the largest of a falling series of levels
/// from which all of 2048 states came to the orbit. `slowest_rate`: of approach, negative. False if there is none.
bool validate(std::vector<OrbitTrap>& copies, const TrialSettings& settings, double slowest_rate);

/// The same for an orbit of a rotor with anisotropic supports or gravity.
bool validate(StrobedTrap& trap, const TrialSettings& settings, double slowest_rate);

}  // namespace equipoise
