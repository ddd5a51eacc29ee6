// Numbers of publications as this program has them: each from a study, with its error.
#pragma once

#include <array>

#include "equipoise/extras/publications/publication.hpp"

namespace equipoise::measures {

/// Largest deflection between two times, on a trajectory from the study's start: the distance of the rotor's centre
/// from the axis; of a rotor that tilts the mean of its shaft's distances one race radius to either side.
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
/// Value between two, that `set` gives the study, at which balance turns from stable to unstable or back: there the
/// largest real part of its rates is zero. Without `set` the prescribed speed.
Estimate boundary(const Study& study, double low, double high, void (*set)(Study& study, double value));
Estimate boundary(const Study& study, double low, double high);
/// Speed between two at which a rotor that tilts vibrates most without balls, at these places of its shaft.
Estimate resonance(const Study& study, double low, double high, std::array<double, 2> places = {1.0, -1.0});

// Of rotors that tilt: shaft_measures.cpp.

/// Steady motion of the rotor without balls at a speed: mean of the largest deflections at two places of its shaft.
double shaft_vibration(const model::Parameters& p, double speed, std::array<double, 2> places);
/// Undamped critical speed of the rotor without balls with this number, lowest first, from 0; it whirls as it spins.
Estimate critical_speed(const Study& study, int number);
/// Mean of the largest deflections at two places of the shaft between two times, from a trajectory.
Estimate largest_at(const Study& study, std::array<double, 2> places, double from, double until);
/// Least rate of any ball until this time; negative if it lags.
Estimate least_ball_rate(const Study& study, double until);
/// Angle of a ball at this time.
Estimate last_angle(const Study& study, int ball, double until);
/// Speed of the rotor when last between two times a ball lagged by more than a tenth of the unit.
Estimate lags_until(const Study& study, double from, double until);
/// Speed of the rotor when last between two times a ball itself ran slower than `below`.
Estimate slow_until(const Study& study, double below, double from, double until);
/// Mean speed of all balls between two times; the error is half the range of theirs.
Estimate ball_speed(const Study& study, double from, double until);
/// Period of a limit cycle: at the speed `from` the study's start comes near to it in this time, and it takes about so
/// long; from there it is followed to the study's speed.
Estimate cycle_period(const Study& study, double from, double until, double about);
/// How far apart the ends of that cycle are along x (0) or y (1), for the rotor's centre.
Estimate cycle_extent(const Study& study, double from, double until, double about, int axis);
/// Period of the cycles that are born where balance changes its stability between `born` and `high`, where their
/// branch, followed within `low` and `high`, comes to the study's speed for the first time. It may pass folds.
Estimate branch_period(const Study& study, double low, double born, double high);

/// Jeffcott's rotor: distance of the centre from the axis at constant speed.
double jeffcott_radius(const model::Parameters& p, double speed);
/// Speed between two at which the motor gives as much as the dampers take of Jeffcott's rotor.
double sommerfeld_speed(const Study& study, double low, double high);

}  // namespace equipoise::measures
