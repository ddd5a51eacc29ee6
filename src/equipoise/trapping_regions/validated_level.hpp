// How far a trapping region can be widened: levels from whose edge every one of four thousand tried states comes to the
// attractor.
#pragma once

#include <vector>

#include "equipoise/attractors/motion.hpp"
#include "equipoise/classification/classification_rule.hpp"
#include "equipoise/trapping_regions/orbit_region.hpp"
#include "equipoise/trapping_regions/trials.hpp"

namespace equipoise {

/// Sets the level of a motion's trapping regions, one or more, exchange images of each other: half the highest of a
/// falling series of levels from which all of 4096 states came to the motion. `slowest_rate`: of approach, negative.
/// False if there is none, or if to look for one would take longer than an ensemble. `near`: as of
/// highest_good_level(). `floor`: V of the same motions of the rotors that tries have (own_floor()), to which it can
/// fall at most.
bool validate(std::vector<OrbitRegion>& regions, const TrialSettings& settings, double slowest_rate, double near = 0.0,
              double floor = 0.0);

/// Four times the largest V of the motion that these rotors, few of those that tries have, have in place of the one
/// that the trapping region surrounds. Infinite if one has another motion there, or none: is_it() says which is the
/// same.
double own_floor(const OrbitRegion& region, const TrialSettings& settings, const Motion& motion,
                 const std::function<bool(const model::Parameters&, const Motion&)>& is_it);

/// Widens `trapping region`, whose level must be one inside which V decreases, to where all of 4096 states on twice the
/// level come to balance: by a factor of at most 64, so that twice the level lies within half a turn of any ball and
/// below `nearest_foreign`, the smallest V on any pilot trajectory that ended elsewhere. `balanced`: the trapping
/// regions of all balanced states, this one's among them, at levels inside which V decreases: to whichever a state
/// comes, it balances. `near`: the factor that it may be, 0 if that is not known.
void widen(BalancedRegion& region, const std::vector<BalancedRegion>& balanced, const TrialSettings& settings,
           double slowest_rate, double nearest_foreign, double near = 0.0);

/// Which of `states`, one after the other, enter a balanced trapping region of `rule` in ten times what the linear flow
/// needs, and none of the trapping regions of other motions that it has before.
std::vector<char> come_to_balance(std::vector<double> states, const ClassificationRule& rule,
                                  const TrialSettings& settings, double slowest_rate);

}  // namespace equipoise
