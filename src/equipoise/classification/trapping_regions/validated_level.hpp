// How far a trapping region can be widened: to a level from whose edge each of four thousand trial states comes to the
// attractor.
#pragma once

#include <vector>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/classification/trapping_regions/orbit_region.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// Sets the level of a motion's trapping regions (one, or several that are exchange images of each other). It is half
/// the highest of a falling series of levels from which all of 4096 states came to the motion. `slowest_rate`: of the
/// approach, negative. False if no level passes, or if the search would take longer than an ensemble. `near`: as in
/// highest_good_level(). `floor`: the least to which V can fall, as rotors of trials have motions of their own
/// (own_floor()).
bool validate(std::vector<OrbitRegion>& regions, const TrialSettings& settings, double slowest_rate, double near = 0.0,
              double floor = 0.0);

/// Four times the largest V of the motion that some of the trials' rotors have in place of the surrounded one; is_it()
/// says which motion is the same. Infinite if a rotor has another motion there, or none.
double own_floor(const OrbitRegion& region, const TrialSettings& settings, const Motion& motion,
                 const std::function<bool(const model::Parameters&, const Motion&)>& is_it);

/// Widens `region`, within whose level V must decrease, as long as all of 4096 states on twice the level come to
/// balance. The factor is at most 64. Twice the level stays within half a turn of any ball and below `nearest_foreign`,
/// the smallest V on any pilot trajectory that ended elsewhere. `balanced`: the regions of all balanced states, with
/// levels inside which V decreases; a state balances whichever it enters. `near`: a guess of the factor, or 0.
void widen(BalancedRegion& region, const std::vector<BalancedRegion>& balanced, const TrialSettings& settings,
           double slowest_rate, double nearest_foreign, double near = 0.0);

/// Which of `states`, one after the other, enter a balanced region of `rule` within ten times what the linear flow
/// takes, without first entering a region of another motion.
std::vector<char> come_to_balance(std::vector<double> states, const ClassificationRule& rule,
                                  const TrialSettings& settings, double slowest_rate);

}  // namespace equipoise
