// Numbers of publications as this program has them: each from a study, with its error.
#pragma once

#include "equipoise/publications/publication.hpp"

namespace equipoise::measures {

/// Largest distance of the rotor's centre from the axis between two times, on a trajectory from the study's start.
Estimate highest(const Study& study, double from, double until);
/// The same, over eight trajectories whose first ball starts up to 1e-3 rad off: mean, and twice the standard deviation
/// of one of them. For motions that do not forget where they began.
Estimate highest_of_irregular(const Study& study, double from, double until);
/// The distance of the rotor without balls from the axis, when all else has died out: from a trajectory.
Estimate settled_without_balls(const Study& study);
/// The same in micrometres, of a study in physical units.
Estimate settled_without_balls_um(const Study& study);
/// Mass of each ball, all alike, from which on balls can cancel the unbalance.
Estimate least_mass(const Study& study);
/// Mean speed of a driven rotor over the last tenth of a trajectory until this time; the error is half its range.
Estimate settled_speed(const Study& study, double until);
/// Share of the study's starts that end balanced, in percent, with Wilson's 95 % interval.
Estimate balanced_percent(const Study& study, const RunOptions& options);
/// Real part of the rate with this number, slowest first, at which deviations from balance grow, in 1/s.
Estimate rate_near_balance(const Study& study, int number);
/// Prescribed speed in rad/s, between two, from which on balance is stable.
Estimate stable_from(const Study& study, double low, double high);
/// Speed between two at which the rotor without balls vibrates most.
Estimate resonance(const Study& study, double low, double high);

/// Jeffcott's rotor: distance of the centre from the axis at constant speed.
double jeffcott_radius(const model::Parameters& p, double speed);
/// Speed between two at which the motor gives as much as the dampers take of Jeffcott's rotor.
double sommerfeld_speed(const Study& study, double low, double high);

}  // namespace equipoise::measures
