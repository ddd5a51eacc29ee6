// Sentences and their parts that reports and pages share.
#pragma once

namespace equipoise::words::text {

// Labels that reports, pages and plots share.
inline constexpr char approach_to_balance[] = "approach to balance";
inline constexpr char balance_quality[] = "balance quality";
inline constexpr char basin_entropy[] = "basin entropy";
inline constexpr char can_balance[] = "can balance";
inline constexpr char critical_speed[] = "critical speed";
inline constexpr char no_balls[] = "no balls";
// Titles of columns.
inline constexpr char no_room_for[] = "Columns left out here: {}. A wider terminal or --json shows them.";
inline constexpr char side_by_side[] = " side by side";
inline constexpr char what_the_balls_do[] = "what the balls do";
inline constexpr char with_balls[] = "with balls";
inline constexpr char without_balls[] = "without balls";
inline constexpr char without_balls_comma[] = " without balls, ";
inline constexpr char worst_in_hundred[] = "worst in a hundred";

// Balance quality and unbalance left.

// Balance quality, grade.
inline constexpr char within_grade[] = "G {:.3g} (within grade G {})";
// Balance quality, worst grade.
inline constexpr char beyond_grade[] = "G {:.3g} (beyond grade G {})";
// Attractor.
inline constexpr char unbalance_left[] = "Unbalance left, {}: ";
inline constexpr char all_within[] = "all within";
inline constexpr char rotors_own[] = "; the rotor's own is {}.\n";

// Stability of a motion.

// States drawn, least and largest rate, unit.
inline constexpr char continuum_unstable[] =
    "UNSTABLE, all of {} states drawn from the continuum, growth rates {:.5f} to {:.5f}{}";
inline constexpr char less_than_one_in[] = "less than 1 in {}";
// Share, fastest and slowest rate, unit.
inline constexpr char continuum_stable_in_part[] =
    "stable in part: {} of the continuum, slowest rates {:.5f} to {:.5f}{}";
inline constexpr char held_by_friction[] = "a continuum that dry friction holds";
inline constexpr char known_by_measurement[] = "starts end in it; known by its measured motion alone";
// Stable or not, rate, unit.
inline constexpr char slowest_rate[] = "{}, slowest rate {:.5f}{}";
// Stable or not, multiplier.
inline constexpr char largest_multiplier[] = "{}, largest multiplier {:.4f}";

// Sampling.

// Starts.
inline constexpr char random_needs_few[] =
    "Sampling: random starts, in blocks; this half-width needs at most {}, too few for a pilot of Sobol starts.\n";
// Starts, Sobol starts, starts of the pilot.
inline constexpr char random_needs_about[] =
    "Sampling: random, about {} starts needed; Sobol starts would need {}, says a pilot of {}.\n";
// Starts, random starts.
inline constexpr char sobol_needs_about[] =
    "Sampling: scrambled Sobol, {} starts; random starts would have needed about {}.\n";
// Cells along a side, exponent.
inline constexpr char jittered_grid[] = "Sampling: jittered grid, {}{} cells, two starts a cell";
// Cells, all of them.
inline constexpr char cells_stand_for_all[] =
    "The balls are alike: {} cells stand for all {}, so shares are weighted, counts are not.\n";
inline constexpr char starts_given[] = "Starts: given, not drawn; intervals are those of random starts.\n";
inline constexpr char scrambled_sobol[] = "Sampling: scrambled Sobol, {} starts.\n";
inline constexpr char intervals_by_replicates[] = "Intervals: Student's t over the {} independent replicates";
inline constexpr char intervals_by_cells[] = "Intervals: from the differences between the two starts of each cell";
inline constexpr char wilson_at_a_dash[] = "; Wilson's where the last column has a dash";
inline constexpr char as_good_as_means[] = ".\nAs good as: random starts that give the same standard error.\n";

// Uncertain values.
inline constexpr char uniform[] = "uniform, {} to {}";
inline constexpr char log_uniform[] = "log-uniform, {} to {}";
inline constexpr char cut_to[] = ", cut to {} to {}";
// Mean, deviation, cut.
inline constexpr char normal[] = "normal, mean {}, standard deviation {}{}";
inline constexpr char one_of[] = "one of ";
// Key, distribution.
inline constexpr char drawn_with_each_start[] = "drawn with each start: {} {}\n";
// Keys.
inline constexpr char drawn_not_taken[] =
    "drawn with each start, not taken from the study: {}; simulate starts from there\n";

// Sensitivity.
inline constexpr char nothing_followed[] = "What balance depends on: nothing was followed to the end.\n";
// Starts, all or none.
inline constexpr char depends_on_nothing[] = "What balance depends on: nothing; of {} starts {} balanced.\n";
inline constexpr char balance_depends_on[] = "balance depends on";
inline constexpr char first_order[] = "first order";
inline constexpr char where_start_begins[] = "where the start begins";
inline constexpr char indices_mean[] =
    "First order: the part of the variance of \"ends balanced\" that goes away on average if this alone is "
    "known;\ntotal: the part that is left if all else is.";
// Starts, rows, share, interval.
inline constexpr char balanced_of_rows[] = "{} starts in {} rows, {} of the independent starts balanced ({})";
inline constexpr char undecided_not_balanced[] = "; {} undecided ones count as not balanced";
inline constexpr char partial_rows[] = ". PARTIAL: stopped before all rows were done.\n\n";

// How starts begin.
inline constexpr char end_of_the_rise[] = "the end of the rise";
inline constexpr char last_point_of_speed[] = "the last point of the speed";
inline constexpr char end_of_the_ramp[] = "the end of the ramp";
inline constexpr char end_of_the_run_up[] = "the end of the run-up";
inline constexpr char held_until_speed[] = "balls held until the rotor comes to ";
inline constexpr char held_until_time[] = "balls held until t = ";
inline constexpr char at_speed[] = ", at speed ";
inline constexpr char start_in_one_place[] =
    " are alike and start in one place; computed exactly they would stay together, and real ones part: they are set "
    "about 1e-9 rad apart";

// Balls that hang below the shaft: speeds.
inline constexpr char carried_from[] = "drag carries hanging balls round from {} on";
inline constexpr char carried_one_by_one[] = "drag carries the first of hanging balls round from {} on, all from {} on";
inline constexpr char some_never_carried[] = "balls without drag are never carried round";
// The above, a factor.
inline constexpr char balls_stay_hanging[] =
    "balls that hang below the shaft at the final speed stay there and balance nothing: {}; at the speed reached it "
    "takes {:.3g} times the drag";
inline constexpr char balls_stay_hanging_without_drag[] =
    "balls that hang below the shaft at the final speed stay there and balance nothing: {}";

// The study: speed.

// At rest, speed without torque.
inline constexpr char torque_by_stall[] = "torque {} at rest, none at {}";
// Points, largest torque.
inline constexpr char torque_by_curve[] = "torque by {} points in speed, at most {}";
// Points.
inline constexpr char torque_by_time[] = "torque by {} points in time";
// Speed, gain, limit.
inline constexpr char speed_control[] = "speed control to {}, gain {}{}";
inline constexpr char torque_at_most[] = ", torque at most {}";
// At rest, slope, until when.
inline constexpr char torque_by_line[] = "torque {}, {} a unit of speed{}";
inline constexpr char machine_takes[] = "; the machine takes ";
// Speed, law.
inline constexpr char driven_from[] = "driven from {}: {}";
inline constexpr char constant_speed[] = "constant speed {}";
// First speed, last speed, duration.
inline constexpr char ramp[] = "ramp {} to {} in {}";
// First speed, highest, by when, held to, last speed, by when.
inline constexpr char trapezoid[] = "trapezoid {} to {} by {}, held to {}, to {} by {}";
// Last speed, half time, exponent.
inline constexpr char hill[] = "run-up to {} by a Hill function, half of it at {}, exponent {:.6g}";
// Points, last speed, its time.
inline constexpr char speed_points[] = "{} speed points to {} at {}";
inline constexpr char published_law[] = "; PUBLISHED speed law, psi = t Omega(t)";
inline constexpr char kinematic_law[] = "; kinematic speed law, psi' = Omega(t)";

// The study: rotor and balls. Moments of inertia.
inline constexpr char tilts[] = "tilts: transverse inertia {}, polar {}";
// Plurals of ball and plane, places.
inline constexpr char balls_in_planes[] = "ball{} in plane{} {}";
inline constexpr char race_offset[] = "race offset ";
inline constexpr char balls_roll[] = "balls roll, radius ";
inline constexpr char balls_touch[] = "balls touch at {:.6g} rad, restitution {:.6g}";
inline constexpr char rolling_resistance[] = "rolling resistance {:.6g}, stiction {:.6g}";
inline constexpr char no_balls_semicolon[] = "no balls; ";
// How many, plural, mass, drag.
inline constexpr char balls_are[] = "{} ball{}: mass {}, drag {}; ";
inline constexpr char rotor_is[] = "rotor: eccentricity {}, damping {}\n";
inline constexpr char critical_speed_is[] = "critical speed {}, 1/omega_c = {}\n";
inline constexpr char unit_of_speed_is[] =
    "sqrt(k/M) = {}, 1/omega_c = {}\n";  // if it tilts, or its two critical speeds differ

// Figures of transients.
inline constexpr char same_for_all[] = "{}, the same for all starts\n";
inline constexpr char all_outcomes[] = "all outcomes";
// Outcome, starts.
inline constexpr char too_few_starts[] = "{}: too few starts ({}) for figures\n";
inline constexpr char no_end_seen[] = "no end seen";
// What it is called, starts, of.
inline constexpr char open_in[] = "{}: {} of {} starts";
// Separator, what it is called, starts, of.
inline constexpr char open_when_last_followed[] = "{}{} when last followed: {} of {} starts";
inline constexpr char mean_is_of_others[] = "; the mean is of the others";
inline constexpr char residual_unbalance[] =
    "  residual unbalance at the final speed: e omega = {:.3g} mm/s (as ISO 21940-11 grades it)\n";
inline constexpr char forces_are_rms[] = " Forces at the end are RMS values.";
// Share, interval.
inline constexpr char of_starts[] = "{} of starts ({})";
// Gap, unit, share on the way, in the end, width in the median, unit, at 90 %, unit, gap, unit.
inline constexpr char housing_hit[] =
    "The housing, {:.4g} {} away, is hit on the way by {}, in the end by {}. In the end the centre's path is at most "
    "{} {} wide in the median and {} {} in 90 % of starts, between walls {} {} apart.";
inline constexpr char transients_title[] = "transients (95 % intervals)";
inline constexpr char below_90_title[] = "90 % of starts below";
inline constexpr char below_99_title[] = "99 % of starts below";
inline constexpr char settled_means[] = "Settled: displacement below {:.4g} {}.\n";
// Window of undecided starts, or nothing.
inline constexpr char at_the_end_means[] = "\n\"At the end\": in the steady motion that a start ends in{}.\n";
// Length, unit.
inline constexpr char window_of_undecided[] = "; of an undecided start in its last window of {:.4g} {}";
inline constexpr char rms_velocity_means[] =
    "RMS velocity: of both directions together; one alone has about 0.71 of it.\n";
inline constexpr char rms_velocity_of_both[] =
    "RMS velocity: of both directions together; \"one direction\" is X or Y, whichever has more.\n";
// Of rotors that tilt. Of which supports forces are told.
inline constexpr char told_at_bearings[] =
    "displacements and velocities are those of the outermost bearing that has more of them; forces are those of {}";
inline constexpr char told_at_centre_of_mass[] =
    "No bearings are stated: displacements and velocities are those of the shaft at the centre of mass; forces are "
    "those of {}";
inline constexpr char unbalance_in_planes[] =
    "; the residual unbalance is that in the plane of the outermost bearing that has more of it for its share of what "
    "the rotor may have, as ISO 21940-11 shares it out";
inline constexpr char unbalance_is_static[] =
    "; the residual unbalance is the static one alone, which has no balance quality grade: ISO 21940-11 judges a rotor "
    "that tilts in the planes of two bearings, and two are not stated";
inline constexpr char forces_of_supports[] = "all supports together";
inline constexpr char forces_of_bearing[] = "the bearing that takes most";
// Sag, unit, weight, unit.
inline constexpr char measured_from_rest[] =
    "Displacements are measured from where the rotor rests, {:.4g} {} below its unloaded springs; bearing forces "
    "include its weight, {:.4g} {}; dynamic forces are without what carries it there.\n";
inline constexpr char lost_left_out[] = "{} starts diverged or failed and are left out here.\n";

// With and without balls.

// Figure, median, 90 % quantile.
inline constexpr char times_without_balls[] = "{}: {:.3g} times that without balls in the median, {:.3g} at 90 %";
// Within or over, on the way.
inline constexpr char bare_rotor_ends[] = "without balls the rotor ends {}{}";
inline constexpr char within_all_limits[] = "within all limits";
inline constexpr char over_a_limit[] = "over a limit";
inline constexpr char never_over_on_the_way[] = ", and is never over one on the way";
inline constexpr char over_on_the_way[] = ", and is over one on the way";
// Share, on the way.
inline constexpr char bare_runs_end_within[] = "without balls {} of the runs end within all limits{}";
inline constexpr char bare_runs_never_over[] = ", and {} are never over one on the way";
// Runs with it, all.
inline constexpr char in_runs[] = " in {} of {} runs";
inline constexpr char e_omega[] = "e omega of that, mm/s";
// Run or runs without balls, runs with balls held.
inline constexpr char columns_mean[] = "No balls: {}. Balls held where they start: median of {}. With balls: median.";
inline constexpr char one_run[] = "one run";
inline constexpr char median_of_runs[] = "median of {} runs";
// Without balls or with balls held, in how many runs, speed.
inline constexpr char motor_fails[] = "{} the motor does not bring the rotor up to speed{}{}";
inline constexpr char it_ends_at[] = ": it ends at ";
// As above, without the speed.
inline constexpr char no_steady_motion[] =
    "{} the rotor comes to no steady motion{}: figures at the end are the last seen";
// As above, without the speed.
inline constexpr char motion_lost[] = "{} the rotor's motion is lost{}";
inline constexpr char with_balls_held[] = "with balls held";

// Why to leave the balancer out below the critical speed. Speed, critical speed, what balls do there.
inline constexpr char leave_out[] = "Leave the balancer out: {}.";
inline constexpr char below_resonance[] = "the rotor runs at {}, below its critical speed of {} with balls: there {}";
inline constexpr char below_resonance_whatever_is_drawn[] =
    "the rotor runs below its critical speed with balls, whatever is drawn: there {}";
inline constexpr char balls_add_to_unbalance[] = "balls gather on the heavy side and add to the unbalance";
inline constexpr char balls_cancel_nothing[] = "balls cancel no unbalance";
inline constexpr char balls_held_title[] = "balls held";

}  // namespace equipoise::words::text
