// What the reports of each analysis say, for the terminal and as CSV.
// This room: the sentences of this chapter.
#pragma once

namespace equipoise::words::reports {

// Attractors.

// Starts, decided ones.
inline constexpr char starts_searched[] = "{} starts searched, {} decided";
inline constexpr char missed_with_probability[] =
    ": an attractor with a share above {:.2g} of such starts is missed with probability below 1e-9";
// Their share.
inline constexpr char undecided_may_hide[] =
    "{} of all starts stayed undecided: attractors missing here may hold up to that share.\n";
inline constexpr char in_one_period[] = "in one period";
inline constexpr char never_the_same_again[] = "and so on, without repeating";
inline constexpr char a_strobe_is[] = "One strobe is {} of the rotor";
inline constexpr char half_a_revolution[] = "half a revolution";
// Height, unit.
inline constexpr char displacement_from_rest[] = "; r is measured from where the rotor would rest, Y = {:.5g}{}";
inline constexpr char multipliers_over_the_period[] = "; multipliers are over the period, without one of 1.\n";
inline constexpr char drift_of_the_balls[] = "drift of the balls";
// Starts done, asked.
inline constexpr char partial_search[] =
    "PARTIAL: stopped after {} of {} starts; the search had not ended: there may be others.\n";
// Seed, how it was computed, version.
inline constexpr char attractors_made_with[] = "seed {}; {}; equipoise {}\n";

// Basin: how starts were decided, passed the resonance, touched.
inline constexpr char decided_by[] = "Decided by: {} of all starts.\n";
// Above or through, share, interval, speed.
inline constexpr char passed_resonance[] =
    "{}: {} of all starts ({}), turning faster than {} in their motion or when last seen";
inline constexpr char above_the_resonance[] = "Above the resonance in the end";
inline constexpr char through_the_resonance[] = "Came through the resonance";
inline constexpr char held_below[] = "; held below: {}";
inline constexpr char passage_not_known[] = "; not known yet: {}, undecided and slower when last seen";
inline constexpr char surely_through[] = "; through, whatever the others do: ";
inline constexpr char no_contact[] =
    "Contact: in no start did balls touch before its fate was known, so contact decided none.\n";
// Share, interval.
inline constexpr char contact[] = "Contact: balls touched in {} of all starts ({}) before the outcome was known.\n";

// Of the changes that were not given up: seconds, CPU seconds.
inline constexpr char changes_took[] = "; the changes judged: {:.2f} s, {:.2f} s CPU";

// Basin: stopped runs.

// Starts, " of" those asked.
inline constexpr char partial_basin[] =
    "PARTIAL: stopped after {}{} starts; the shares and intervals above are of those.\n";
inline constexpr char partial_nothing_known[] = "PARTIAL: stopped before anything was known.\n";
inline constexpr char partial_no_shares[] =
    "PARTIAL: stopped before the first start was decided; there are no shares.\n";

// Notes about balance (classification/words/proof.hpp): forms that find their numbers, and what stands in their place.
// Speed.
inline constexpr char speed_in_note[] = "at speed (-?[0-9][0-9.e+-]*)";
inline constexpr char at_speed[] = "at speed {:.4g}";
inline constexpr char at_speed_of_machine[] = "at {}";
// Rates, the second of which may be missing, in 1/s.
inline constexpr char rates_in_note[] = "\\(growth (rates?) (-?[0-9][0-9.e+-]*)(?: to (-?[0-9][0-9.e+-]*))?\\)";
inline constexpr char second_rate[] = " to {}";
inline constexpr char rates_of_machine[] = "(growth {} {}{} 1/s)";

// Basin: the rotor alone.
inline constexpr char one_run_tells_all[] = "There are no balls: nothing is random, so one run is enough.";
inline constexpr char runs_draw_the_rest[] = "There are no balls: {} runs draw the uncertain values.";

// Basin: outcomes.
inline constexpr char stalled_below[] = "stalled below ";
inline constexpr char came_to[] = "came to: ";
inline constexpr char and_none[] = "; and none ";
inline constexpr char was_undecided[] = "was undecided";
inline constexpr char no_start[] = "No start ";
// "each " or nothing, share.
inline constexpr char at_most_whatever_undecided[] = " ({}at most {}, however the undecided starts end)";
inline constexpr char while_followed[] = " while followed";
inline constexpr char bounds_hold[] =
    "Intervals hold only if the undecided starts end elsewhere; bounds are 95 % limits that hold however they end.";
// Unit of a dimensionless study, or nothing.
inline constexpr char known_after_means[] =
    "Known after: mean time until the outcome is certain, from when the drive no longer changes and the balls are "
    "free{}.";
inline constexpr char share_and_interval[] = "share, 95 % interval";
inline constexpr char rms_at_end[] = "RMS at end, {}";
inline constexpr char known_after_seconds[] = "known after, s";
inline constexpr char known_after[] = "known after";
inline constexpr char as_good_as[] = "as good as";

// Attractors along a parameter.

// "at" or "from", range, which side.
inline constexpr char seen_not_followed[] = "seen {}{}, not followed further{}";
// Key and label, first value, last value, values.
inline constexpr char along[] = "along {}: {:.12g} to {:.12g}, {} values\n\n";
// First value, last value, starts.
inline constexpr char range_may_go_on[] =
    "\nA range that begins at {:.12g} or ends at {:.12g} may continue beyond it. At every value and half-way between, "
    "{} random starts and the pilot were searched. Attractors to which fewer come are not listed, nor those that exist "
    "only between two of these values. States that you give are followed too.\n";
inline constexpr char partial_branches[] =
    "PARTIAL: stopped before every branch was followed to its ends; there may be others, and events beyond.\n";
// Seconds, threads, plural, target, version.
inline constexpr char branches_made_with[] = "{:.1f} s on {} thread{} ({}); equipoise {}\n";
// Version, key, whether partial.
inline constexpr char csv_branches[] = "# equipoise {}: attractors along {}{}\n";
inline constexpr char csv_partial_early[] = ", PARTIAL: stopped early";
// Branch, change, cause, between which values.
inline constexpr char csv_event[] = "# event: id {}, {}, {}, between {} and {}\n";

// Capacities.
inline constexpr char undecided_at_most[] = "undecided at most";
inline constexpr char between_means[] =
    "Between: at the first value the share is large enough with 95 % confidence, however the undecided starts end; at "
    "the second it is too small with 95 % confidence.";
inline constexpr char open_means[] = " Of an open one the capacity is not known between the two values.";
inline constexpr char unknown_means[] = " ?: no value tried says so.";
// Key, percentage, what starts do, range searched.
inline constexpr char largest_at_which[] = "The largest {} at which {:.4g} % of starts {}, searched from {}.\n\n";
inline constexpr char located_to[] =
    "Located to {}; a dip of the share between two of the values tried would be missed.\n";
inline constexpr char partial_cells[] = "PARTIAL: stopped before all cells were done.\n";
inline constexpr char trials_from_earlier[] = "{} trials from an earlier run. ";
// Starts, seed, how it was computed, version.
inline constexpr char capacity_made_with[] = "{} starts a trial, seed {}, the same ones in all; {}; equipoise {}\n";
// Version, key, share, starts, what they do, range searched, whether partial.
inline constexpr char csv_capacity[] =
    "# equipoise {}: largest {} at which a share of {} of {} starts {}, searched from {}{}\n";

// Faults of a file of certificates.
inline constexpr char must_be_object[] = "must be an object";
inline constexpr char must_be_true_or_false[] = "must be true or false";
inline constexpr char must_have_rows[] = "must have {} rows";
inline constexpr char must_be_lists_of_numbers[] = "must be an array of arrays of numbers";
inline constexpr char is_missing[] = "is missing";
inline constexpr char must_be_finite[] = "must be a finite number";
inline constexpr char must_be_numbers[] = "must be an array of {} numbers";
inline constexpr char must_be_positive[] = "must be greater than 0";
// Fewest, most balls.
inline constexpr char must_be_whole[] = "must be a whole number from {} to {}";
inline constexpr char not_json[] = "is not JSON; must be a file written by equipoise certify -o";
inline constexpr char must_be_format[] = "must be \"{}\"";
inline constexpr char must_hold_a_certificate[] = "must be an array of at least one certificate";
inline constexpr char must_be_array[] = "must be an array";

// Proofs.
inline constexpr char balanced_state[] = "balanced state {}";
inline constexpr char copy_has_same_proof[] = "; its exchange copy (equal balls) has the same proof";
inline constexpr char not_proved[] = "  not proved: {}\n";
// Level, percentage of the critical one.
inline constexpr char proved[] =
    "  proved: V = d^T P d decreases on 0 < V <= c, c = {:.9g}: {} % of the sampled critical level\n";
inline constexpr char reach[] = "  reach of V <= c:";
// Boxes as below, seconds, seconds of the re-check, whether it holds.
inline constexpr char boxes_checked[] = "  {}, found in {:.3f} s; re-check in {:.3f} s: {}\n";
// Members drawn, attracting, unstable, neither.
inline constexpr char members_proved[] =
    "the balanced states form a continuum; of {} members drawn evenly from it {} are proved to attract all that comes "
    "close, {} to be unstable, {} neither\n";
// Angles, radius, level, rate.
inline constexpr char member_attracts[] =
    "  attracts: {}; balls within {:.3g} rad of that and V <= {:.3g} lead to balance (rate {:.4g})\n";
// Angles, rate.
inline constexpr char member_unstable[] = "  unstable: {}; leads away from the set (growth rate {:.4g})\n";
inline constexpr char others_not_proved[] = "  nothing is proved of members that were not drawn\n";
inline constexpr char nothing_proved[] = "nothing proved: ";
inline constexpr char partial_proofs[] = "PARTIAL: stopped; what is not proved above was not tried to the end.\n";
// Speed, " by a motor", balls, plural, level, boxes, verdict.
inline constexpr char certificate_line[] = "speed {}{}, {} ball{}, level {:.9g}, {}: {}\n";
inline constexpr char boxes[] = "{} boxes";
// Of a rotor that tilts.
inline constexpr char one_box[] = "one box";
inline constexpr char by_a_motor[] = " by a motor";
// Speed, balls, angles, attracts or unstable, verdict.
inline constexpr char member_line[] = "speed {}, {} balls, member {}, {}: {}\n";

// Comparisons.
inline constexpr char mean_of_starts[] = "mean of starts";
// Which kind of samples, the next sentence or nothing.
inline constexpr char means_of[] = "Means and 95 % intervals of {}.{}";
inline constexpr char differences_by_start[] = "differences start by start";
inline constexpr char independent_samples[] = "independent samples";
inline constexpr char open_figures[] =
    " Open: starts of the first and of the second whose figure is without bound; the means are of the others.";
inline constexpr char nothing_to_compare[] =
    "No start of both is done: there is nothing to compare (basin -o keeps what it has done).";
inline constexpr char neither_balances[] = "No start of either ends balanced.";
// Difference, interval.
inline constexpr char by_points[] = "by {} points ({})";
// What the second does: "balances", and by how much.
inline constexpr char second_more_often[] = "The second {} more often, {}.";
inline constexpr char second_less_often[] = "The second {} less often, {}.";
inline constexpr char balances[] = "balances";
inline constexpr char keeps_every_limit[] = "keeps every limit";
inline constexpr char keeps_its_own_limits[] = "keeps its own limits";
// Of which starts, by how much, surely lowest, surely highest.
inline constexpr char difference_open[] =
    "Open: the difference in {} is {}, but undecided starts could undo it ({} to {}).";
inline constexpr char no_difference[] = "No difference in {} is shown: {} points.";
inline constexpr char balanced_starts[] = "balanced starts";
inline constexpr char starts_within_all_limits[] = "starts within all limits";
inline constexpr char interval_in_points[] = "95 % interval, points";
// Starts, of, share, interval.
inline constexpr char common_end_differently[] = "{} of {} common starts end differently: {} ({})\n";
// Starts, outcomes.
inline constexpr char from_one_to_other[] = "{:>10}  from {} to {}\n";
inline constexpr char compared_as_independent[] = "Compared as independent samples: {}.\n";
inline constexpr char partial_comparison[] =
    "PARTIAL: stopped before all starts were done; what is said above is of those that were.\n";

// Designs: the chosen one and its margins.
inline constexpr char nothing_tried_fails[] = "nothing that was tried";
// Starts, value, figure, optimistic or pessimistic.
inline constexpr char search_thought[] = "; on the {} starts of the search it was {} ({}), {}";
inline constexpr char was_optimistic[] = "which was optimistic";
inline constexpr char was_pessimistic[] = "which was pessimistic";
inline constexpr char chosen_is_marked[] =
    "The chosen one is marked: it lies nearest to the best of every objective, each scaled by the front's own range.";
// Starts, which, seed, what the search thought.
inline constexpr char over_starts[] = "With 95 % intervals, over {} starts{}, seed {}{}.";
inline constexpr char search_did_not_see[] = " that the search did not see";
inline constexpr char of_the_search[] = " of the search";
inline constexpr char choices_have_no_ends[] = "choices have no ends";
// What ends them, the first objective.
inline constexpr char margins_mean[] =
    "{} Near it: by how much {} changes at most within a tenth of the range; what matters most comes first.";
inline constexpr char until_objective_worse[] = "Until the first objective is shown to be worse.";
inline constexpr char until_requirement_fails[] = "Until a requirement fails.";
inline constexpr char must_be_title[] = "must be";
inline constexpr char varied_alone[] = "varied alone";
inline constexpr char may_go_from[] = "may go from";
inline constexpr char near_it[] = "near it";
inline constexpr char what_fails_beyond[] = "what fails beyond";

// Designs: the report.
inline constexpr char must_be[] = "Must be: ";
// What it was judged on.
inline constexpr char partial_design[] = "\nPARTIAL: stopped; what the search had found by then, judged on {}. ";
inline constexpr char starts_not_seen[] = "starts that it did not see";
inline constexpr char starts_of_search[] = "its own starts";
inline constexpr char checks_still_to_make[] = "Some of its checks were still to be made.\n";
// Left, budget.
inline constexpr char trajectories_left[] =
    "{} of {} trajectories were left, for more candidates and for checks of the best.\n";
inline constexpr char design_proposed[] = "The study states no [design]; proposed [design]:\n";
inline constexpr char chosen_is_starred[] = "{}, * the chosen one:\n";
inline constexpr char best_candidate[] = "The best candidate";
inline constexpr char not_beaten[] = "{} candidates that no other beats";
inline constexpr char what_limits_it[] = "\nWhat limits it:\n";
inline constexpr char ensembles_from_earlier[] = "\n{} ensembles from an earlier run. ";
// Candidates, method, trajectories, budget, how it was computed, version.
inline constexpr char design_made_with[] = "\n{} candidate{} by {}, {} trajectories of {}; {}; equipoise {}\n";
// Version, whether partial.
inline constexpr char csv_front[] = "# equipoise {}: candidates that no other beats{}\n";

// Explanations: speeds and run-up.
inline constexpr char with_balls_in_race[] = " with the balls in the race";
// Of a rotor that tilts. Speeds without balls, with balls.
inline constexpr char forward_whirl[] = "forward whirl: {} without balls{}";
inline constexpr char backward_whirl[] = "backward whirl: {} without balls{}; unbalance does not excite it";
inline constexpr char whirl_of_both[] = "{} without balls{}";
inline constexpr char with_balls_held[] = ", {} with them held";
inline constexpr char one_forward_whirl[] =
    "the gyroscopic moment of this disc leaves no second critical speed of forward whirl";
inline constexpr char final_speed[] = "final speed";
// Speed, times, "higher ", " with balls".
inline constexpr char times_the_critical[] = "{}, {:.3g} times the {}critical speed{}";
inline constexpr char and_with_balls[] = " with balls";
// Time, speed, inertia.
inline constexpr char run_up_without_losses[] =
    "{} to {}, 95 % of that, without losses; the moment of inertia of rotor and balls is {}";
// Speed.
inline constexpr char motor_fails[] = "the motor does not bring the rotor to {}, 95 % of that";
// Time, what is left out.
inline constexpr char run_up_shaken[] =
    "{} with the torque that the rotor's own unbalance absorbs up to sqrt(2) critical speeds{}";
inline constexpr char balls_left_out[] = "; what the balls add to that is left out";
// Speed.
inline constexpr char stalls_in_resonance[] =
    "never with the torque that the rotor's own unbalance absorbs up to sqrt(2) critical speeds: it stalls at {}";

// Explanations: balance.

// Unbalance, least, most, " side by side".
inline constexpr char cancels[] = "unbalance {}; these balls cancel from {} to {}{}";
// Of a rotor that tilts: static part, couple part; place, unbalance, least, most.
inline constexpr char static_and_couple[] = "static unbalance {}, couple unbalance {}";
inline constexpr char plane_cancels[] = "plane at {}: unbalance {}; its balls cancel from {} to {}";
inline constexpr char own_unbalance[] =
    "the rotor's own is {}; the off-centre race changes it to that at the final speed";
inline constexpr char static_sag[] = "static sag";
// Sag, weight.
inline constexpr char sags_under[] =
    "{} under the weight of {}; displacements are measured from there, bearing forces include it";
inline constexpr char gravity_ratio[] = "{:.3g} of a ball's centrifugal force at the final speed";
inline constexpr char balanced_angles[] = "balanced angles";
// Angles, what else there is.
inline constexpr char from_heavy_side[] = "{} degree from the heavy side{}";
inline constexpr char from_couple_unbalance[] = "{} degree from the couple unbalance{}";
inline constexpr char from_angle_0[] = "{} degree from the rotor's angle 0{}";
inline constexpr char one_of_states[] = " (one of {} states)";
inline constexpr char one_of_continuum[] = " (one of a continuum)";
inline constexpr char and_mirror_image[] = " (and their mirror image)";
inline constexpr char at_constant_speed[] = " at constant speed";
inline constexpr char hardly_changed[] = "hardly changed";
// Where, time, how more drag changes it.
inline constexpr char balance_stable[] = "stable{}; slowest time constant {}, {} with more drag";
// Where, rate.
inline constexpr char balance_unstable[] = "NOT stable{}: largest growth rate {:.3g}";
// Where.
inline constexpr char balance_marginal[] = "NOT stable{}: the largest rate is within 1e-9 of 0";
inline constexpr char balls_rock[] =
    "the balls rock as the rotor turns: the centre of the race keeps moving, by up to {}";
inline constexpr char if_balls_slid[] = "if the balls slid instead of rolled: ";
inline constexpr char rate_by_multipliers[] = "rate, by multipliers";
inline constexpr char time_constant[] = "time constant";
inline constexpr char growth_rate[] = "growth rate {:.3g}";
inline constexpr char yes_not_stable[] = "yes, but balance is not stable at the final speed";
inline constexpr char yes_by_mass[] = "the balls have the mass and the room, but ";
inline constexpr char yes_but_gravity[] = "yes, apart from what gravity adds";

// Explanations: without balls, rules, cost.
inline constexpr char amplitude_at_final_speed[] = " amplitude at the final speed";
inline constexpr char amplitude_at_centre_of_mass[] =
    " amplitude of the shaft at the centre of mass, at the final speed";
// Displacements.
inline constexpr char farthest_at_bearings[] = "{} at the bearings, at the farthest";
// Forces.
inline constexpr char forces_at_bearings[] = "{} of force at the bearings, at the largest";
inline constexpr char rms_velocity[] = " rms velocity in one direction";
inline constexpr char amplitude_of_force[] = " amplitude of the force on the supports";
inline constexpr char amplitude_of_sum[] = " amplitude of the force on all supports together";
inline constexpr char no_couple_in_sum[] = ", in which a couple does not show";
inline constexpr char grade_is_a_figure[] =
    "; eps omega in mm/s as ISO 21940-11 grades it: a figure, not a certification";
inline constexpr char grade_in_planes[] =
    "; in the worse of the outermost bearings' planes, each by its share, as ISO 21940-11 grades it: a figure, not a "
    "certification";
inline constexpr char no_grade_without_planes[] =
    "none: ISO 21940-11 judges a rotor that tilts in the planes of two bearings; state rotor.tilt.bearings or "
    "rotor.tilt.bearings_at";
inline constexpr char rules_of_thumb[] =
    "\nRules of thumb: estimates by formulas; docs/explanation/rules-of-thumb.md derives them and says how often each "
    "is right\n";
inline constexpr char reynolds_number[] = "Reynolds number";
inline constexpr char reynolds_of[] =
    "{:.3g} of a ball that keeps the critical speed while the rotor runs at its final one";
inline constexpr char no_warnings[] = "no warnings\n";
inline constexpr char basin_takes[] = "basin takes";
// Seconds, what had not ended.
inline constexpr char takes_more_than[] = "more than {:.2g} s of CPU: {} had not ended by then";
inline constexpr char the_first_starts[] = "the first starts";
inline constexpr char the_search[] = "the search for attractors";
// Seconds, seconds of the search, microseconds a start, starts, starts measured.
inline constexpr char takes_about[] =
    "about {:.2g} s of CPU: {:.2g} s for the search for attractors, {:.2g} us for each of {} starts, measured on {}";

// Files.
inline constexpr char of_version[] = ", of equipoise {}";

// Maps.

// Letter, key, lowest, highest, pixels, how far apart.
inline constexpr char map_axis[] = "{}: {} from {:.10g} to {:.10g}, {} pixels{}\n";
inline constexpr char pixels_apart[] = " ({} apart; all are in the output)";
// Seed.
inline constexpr char pixels_draw_angles[] =
    "Every pixel draws its own ball angles (seed {}); state initial.phi to start them all alike.\n";
// Angles, whether they are evenly spread.
inline constexpr char pixels_start_with[] = "All pixels start with {}{}.\n";
inline constexpr char evenly_spread[] = ", evenly spread";
// Pixels.
inline constexpr char pixels_from_output[] = "{} pixels read from the output, where an earlier run left them.\n";
inline constexpr char pixels_left_out[] =
    "{} pixels start alike balls in one place, a set of probability zero; shares and figures leave them out.\n";
inline constexpr char overlaps_left_out[] =
    "In {} pixels balls would overlap, which is not a start; shares and figures leave them out.\n";
inline constexpr char of_the_map[] = "of the map";
inline constexpr char box_dimension[] = "box dimension";
inline constexpr char uncertainty_exponent[] = "uncertainty exponent";
inline constexpr char boundary_basin_entropy[] = "boundary basin entropy";
// Its name, radius.
inline constexpr char around_balanced[] = "{:<25} {:.3f} rad around balanced angles\n";
inline constexpr char balanced_within[] = "all balanced within";
// Shortest and longest distance in pixels, exponents.
inline constexpr char exponent_scales[] =
    "The exponent is that of distances from {} to {} pixels; from each distance to its double it is {}.\n";
inline constexpr char figures_mean[] =
    "95 % intervals: of the line fitted through the scales, and over boxes of 5 x 5 pixels. A boundary entropy above "
    "log 2 = 0.693 indicates a fractal boundary.\n\n";
// Open pixels, all.
inline constexpr char partial_map[] =
    "PARTIAL: stopped with {} of {} pixels open. Shares of the map: the least if no open pixel comes to an outcome, "
    "the most if all do.\n";
// All pixels.
inline constexpr char partial_map_of_nothing[] =
    "PARTIAL: stopped before any of {} pixels was done; nothing is known of the map.\n";
// Pixels, how it was computed, pixels a second, version.
inline constexpr char map_made_with[] = "{} pixels; {}{}; equipoise {}\n";

// Sweeps.

// Separator, motion, its largest share, cells, plural.
inline constexpr char another_motion[] = "{}{}, {} at most, in {} cell{}";
inline constexpr char keep_all_limits[] = "keep all limits";
// Cell, note.
inline constexpr char note_at[] = "Note at {}: {}.\n";
inline constexpr char lost_starts[] = "{} starts diverged or failed.\n";
inline constexpr char intervals_are[] = "Behind ± or in brackets: 95 % intervals.\n";
// Cells done, all.
inline constexpr char partial_sweep[] = "PARTIAL: {} of {} cells; the rest is missing.\n";
// Cells, starts, seed.
inline constexpr char sweep_made_with[] = "{} cell{}, {} starts, seed {}, the same starts in every cell";
inline constexpr char cells_from_earlier[] = "; {} cell{} from an earlier run";
inline constexpr char csv_cells_missing[] = ", PARTIAL: cells are missing";

}  // namespace equipoise::words::reports
