// How far a trap can be widened: levels from whose edge every one of thousands of tried states comes to the attractor.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/base/stage_progress.hpp"
#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/model/parameters.hpp"
#include "equipoise/orbits/balanced_continuum.hpp"
#include "equipoise/traps/strobed_trap.hpp"

namespace equipoise {

/// What the tries share.
struct TrialSettings {
  const model::Parameters* parameters = nullptr;
  double speed = 0.0;
  double tolerance = 1e-6;
  int threads = 1;
  const StopFlag* stop = nullptr;
  StageProgress* progress = nullptr;
};

/// Widens `trap`, whose level must be one inside which V decreases, to where all of 4096 states on twice the level come
/// to balance: by a factor of at most 64, so that twice the level lies within half a turn of any ball and below
/// `nearest_foreign`, the smallest V on any pilot trajectory that ended elsewhere. `balanced`: the traps of all
/// balanced states, this one's among them, at levels inside which V decreases: to whichever a state comes, it balances.
void widen(BalancedTrap& trap, const std::vector<BalancedTrap>& balanced, const TrialSettings& settings,
           double slowest_rate, double nearest_foreign);

/// Which of `states`, one after the other, enter one of the `balanced` traps in ten times what the linear flow needs.
std::vector<char> come_to_balance(std::vector<double> states, const std::vector<BalancedTrap>& balanced,
                                  const TrialSettings& settings, double slowest_rate);

/// Sets the level and with it the reach.
void set_level(BalancedTrap& trap, double level);

/// Sets the level of an orbit's trap, and of its exchange copies alike: half the largest of a falling series of levels
/// from which all of 2048 states came to the orbit. `slowest_rate`: of approach, negative. False if there is none.
bool validate(std::vector<OrbitTrap>& copies, const TrialSettings& settings, double slowest_rate);

/// Level sets around the attracting members of a continuum: all of 1024 states on twice their levels, spread over the
/// members, came near to the continuum and were about to come to a member that attracts. Empty if there are none.
std::optional<ContinuumTrap> continuum_trap(const std::shared_ptr<const BalancedContinuum>& continuum,
                                            const ContinuumSurvey& survey, const TrialSettings& settings);
/// That as DecisionRule::family, for isotropic supports without gravity.
FamilyTrap family_test(const ContinuumTrap& trap, int balls);

/// The same for an orbit of a rotor with anisotropic supports or gravity.
bool validate(StrobedTrap& trap, const TrialSettings& settings, double slowest_rate);

}  // namespace equipoise
