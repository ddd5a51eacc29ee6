// Levels of the balanced trapping regions, beyond those inside which V decreases by sampling: proved, or widened as far
// as tries and the pilot allow.
#pragma once

#include <vector>

#include "equipoise/attractor_search/pilot_run.hpp"
#include "equipoise/trapping_regions/trials.hpp"

namespace equipoise {

void prove_levels(std::vector<BalancedRegion>& regions, const TrialSettings& settings);
/// Those of `rule`, whose other trapping regions tell what does not balance. `slowest_rate`: at which balance is
/// approached, negative. By how much the first one is widened, which `near` may be near to; 0: not known.
double widen_levels(ClassificationRule& rule, const TrialSettings& settings, double slowest_rate, const PilotRun& pilot,
                    double near);

}  // namespace equipoise
