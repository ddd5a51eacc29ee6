// Levels of balanced trapping regions beyond those in which samples of V decrease: proved, or widened as far as trials
// and the pilot allow.
#pragma once

#include <vector>

#include "equipoise/classification/attractor_search/pilot_run.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"

namespace equipoise {

void prove_levels(std::vector<BalancedRegion>& regions, const TrialSettings& settings);
/// Widens the balanced regions of `rule`, whose other regions decide trials that end elsewhere. `slowest_rate`: of the
/// approach to balance, negative. `near`: a guess of the factor, or 0. Returns the first one's factor.
double widen_levels(ClassificationRule& rule, const TrialSettings& settings, double slowest_rate, const PilotRun& pilot,
                    double near);

}  // namespace equipoise
