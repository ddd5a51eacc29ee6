// The balanced motions of a system, their stability, and the trapping regions around them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "equipoise/attractors/equilibria/continuum_of_equilibria.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/note.hpp"
#include "equipoise/results/types/warm_start_levels.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

struct BalancedAnalysis {
  model::BalancedStates states;  ///< as without gravity and with isotropic supports
  bool stable = false;           ///< a linearly stable balanced motion exists or, under gravity, may exist
  double slowest_rate = 0.0;     ///< at which deviations from a stable one die out (negative); 0 if none is stable, and
                                 ///< along a continuum
  double growth_rate = 0.0;      ///< fastest growth at unstable ones, 0 if there are none
  /// Stable ones first. One member stands for a continuum, and one state for two that differ by exchange of alike
  /// balls.
  std::vector<Motion> motions;
  /// Of each stable state, if states are isolated and nothing depends on the rotor's angle. Otherwise trapping regions
  /// belong to the motions (classification/trapping_regions/orbit_region.hpp) or to the continuum.
  std::vector<BalancedRegion> regions;
  std::vector<ModeWeight> weights;                         ///< of the modes of the first region
  std::shared_ptr<const ContinuumOfEquilibria> continuum;  ///< null: the states are isolated
  ContinuumSample sample;                                  ///< of the continuum
  Note note;  ///< one sentence for the reader if no start can end balanced, else empty
};

/// What counts as balanced:
/// - A driven rotor balances at the speed at which its motor's power is what the supports' dampers take.
/// - In an off-centre race, balls bring the race's own centre to the axis of rotation; the shaft stays off it by the
/// offset.
/// - Anisotropic supports leave the balanced states of a centred race as they are, but change their stability.
/// - Gravity makes balls rock once a turn, and so do anisotropic supports under an off-centre race. The balanced motion
/// is then the orbit of one section that a balanced state becomes as gravity and anisotropy are switched on gradually.
/// - For a continuum they leave single motions, which starts have to find (leads_to_balance() recognises them); also
/// with a motor if the rotor's angle matters.
/// - A motor without torque holds no speed: balance, if it comes, may be at any speed.
/// - Balls in contact balance if they have room. Levels of trapping regions are cut so that no balls touch
/// (touching_level()).
/// - Under dry friction balls come to rest near balance, and there is no trapping region;
/// attractors/equilibria/stuck.hpp judges balls that are all stuck. Once `stop` is set the result comes soon and is
/// unusable. `weights`: those of a neighbouring parameter, where the search for forms of trapping regions then begins.
BalancedAnalysis analyse_balanced(const model::System& system, const StopFlag* stop = nullptr,
                                  const std::vector<ModeWeight>& weights = {});

}  // namespace equipoise
