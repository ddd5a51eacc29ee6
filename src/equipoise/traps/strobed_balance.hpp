// The balanced states of a rotor with anisotropic supports or gravity.
#pragma once

#include <vector>

#include "equipoise/model/parameters.hpp"
#include "equipoise/motions/motion.hpp"
#include "equipoise/traps/balanced_trap.hpp"
#include "equipoise/traps/strobed_trap.hpp"

namespace equipoise {

struct StrobedBalance {
  BalancedAnalysis analysis;  ///< without traps
  /// The balanced motions found beforehand, stable ones first; of a continuum one member stands for all.
  std::vector<Motion> motions;
};

/// Anisotropic supports leave the balanced states of the isotropic rotor what they are, and change their stability.
/// Gravity makes the balls rock once a revolution: the balanced motion is then the orbit of one revolution that a
/// balanced state becomes as gravity and anisotropy are switched on gradually. Of a continuum of balanced states
/// gravity leaves single ones, which starts have to find (leads_to_balance() tells them).
/// Once `stop` is set the answer is worth nothing, and comes soon.
StrobedBalance analyse_strobed_balance(const model::Parameters& p, double speed, const StopFlag* stop = nullptr);

}  // namespace equipoise
