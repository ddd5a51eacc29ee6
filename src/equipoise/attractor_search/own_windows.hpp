// What the windows of steady motions show, seen as an ensemble's starts are.
#pragma once

#include <vector>

#include "equipoise/attractors/motion.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/batch/own_rotor.hpp"
#include "equipoise/classification/classification_rule.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

/// A record of each of `motions`, all stable, followed from its own state as the pilot's trajectories are: over windows
/// as long as those of `rule`, until they repeat themselves, or for `longest` times the first long one. `own`: their
/// rotors, where they are not all motions of `system`. If stopped, records without a finished window.
std::vector<PilotRecord> own_windows(const model::System& system, const std::vector<const Motion*>& motions,
                                     std::vector<const OwnRotor*> own, const ClassificationRule& rule, double longest,
                                     double tolerance, const StopFlag* stop);

/// What the rule says of trajectories from these states (at a strobe, where the rotor's angle matters) by its trapping
/// regions and by windows alone, within the same time.
std::vector<Fate> fates_by_windows(const model::System& system, std::vector<double> states,
                                   std::vector<const OwnRotor*> own, ClassificationRule rule, double longest,
                                   double tolerance, const StopFlag* stop);

}  // namespace equipoise
