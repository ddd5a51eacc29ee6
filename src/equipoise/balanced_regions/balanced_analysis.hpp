// The balanced motions of a system: which there are, whether they are stable, and the trapping regions around them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "equipoise/attractors/motion.hpp"
#include "equipoise/base/stop_flag.hpp"
#include "equipoise/classification/classification_rule.hpp"
#include "equipoise/mechanics/balanced_state.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/periodic_orbits/continuum_of_equilibria.hpp"
#include "equipoise/types/warm_start_levels.hpp"

namespace equipoise {

struct BalancedAnalysis {
  model::BalancedStates states;  ///< as without gravity and on supports that do not differ
  bool stable = false;           ///< a balanced motion is there, or under gravity may be, and is linearly stable
  double slowest_rate = 0.0;     ///< at which deviations from a stable one die out (negative), 0 if there is none; and
                                 ///< along a continuum
  double growth_rate = 0.0;      ///< fastest one of unstable ones, 0 if there is none
  /// Stable ones first; of a continuum one member stands for all, and so does one of two states that differ by exchange
  /// of like balls.
  std::vector<Motion> motions;
  /// Of each stable state where nothing depends on the rotor's angle and states are isolated. Elsewhere trapping
  /// regions are those of the motions (trapping_regions/orbit_forms.hpp) or of the continuum.
  std::vector<BalancedRegion> regions;
  std::vector<ModeWeight> weights;                         ///< of the modes of the first of these
  std::shared_ptr<const ContinuumOfEquilibria> continuum;  ///< null: the states are isolated
  ContinuumSurvey survey;                                  ///< of that
  std::string note;  ///< one sentence for the reader when no start can end balanced, else empty
};

/// A driven rotor is balanced at the speed at which its motor gives what the supports' dampers take. Balls in a race
/// off the shaft's centre bring the race's own centre to the axis of rotation, and leave the shaft off it by the
/// offset. Supports that differ leave the balanced states of a centred race what they are, and change their stability.
/// Gravity, and supports that differ under a race off its centre, make the balls rock once a revolution: the balanced
/// motion is then the orbit of one strobe that a balanced state becomes as gravity and anisotropy are switched on
/// gradually. Of a continuum of balanced states these leave single ones, which starts have to find (leads_to_balance()
/// tells them), and so they have to under a motor where the rotor's angle matters. A motor without torque holds no
/// speed: balance, if it comes to that, is at any. Balls in contact are balanced where they have room, and a trapping
/// region's level is cut so that none touch on it (balanced_regions/touching.hpp). Where dry friction acts balls come
/// to rest near balance, and there is no trapping region: what all of them being stuck is worth is told otherwise
/// (attractors/stuck.hpp). Once `stop` is set the answer is worth nothing, and comes soon. `weights`: those of a
/// neighbouring parameter, from which the search for the trapping regions' forms then begins.
BalancedAnalysis analyse_balanced(const model::System& system, const StopFlag* stop = nullptr,
                                  const std::vector<ModeWeight>& weights = {});

}  // namespace equipoise
