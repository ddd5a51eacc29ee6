// The windows of steady motions, seen as those of an ensemble's starts are.
#pragma once

#include <vector>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/fate.hpp"
#include "equipoise/simulation/batch/own_rotor.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// Follows each of `motions`, all stable, from its own state as the pilot's trajectories are. Windows are as long as
/// those of `rule`, and end when they repeat, or after `longest` times the first long one. `own`: their rotors, unless
/// all are motions of `system`. If stopped, records lack a finished window.
std::vector<PilotRecord> own_windows(const model::System& system, const std::vector<const Motion*>& motions,
                                     std::vector<const OwnRotor*> own, const ClassificationRule& rule, double longest,
                                     double tolerance, const StopFlag* stop);

/// Decides trajectories from these states by the rule's trapping regions and windows alone, within the same time. The
/// states lie on a stroboscopic section, if there is one.
std::vector<Fate> fates_by_windows(const model::System& system, std::vector<double> states,
                                   std::vector<const OwnRotor*> own, ClassificationRule rule, double longest,
                                   double tolerance, const StopFlag* stop);

}  // namespace equipoise
