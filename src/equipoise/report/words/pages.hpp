// What pages say around their drawings: headings, captions, notes.
#pragma once

namespace equipoise::words::pages {

// The machine.
inline constexpr char what_was_assumed[] = "What was assumed";
inline constexpr char what_matters_most[] = "What matters most: ";
inline constexpr char the_machine[] = "The machine";
inline constexpr char without_simulation[] = "without any simulation";
inline constexpr char rule_of_thumb[] = "rule of thumb";
inline constexpr char estimate_by_formula[] = "an estimate by a formula";
inline constexpr char formulas_derived_in[] =
    "docs/explanation/rules-of-thumb.md derives these formulas and says how often each is right.";
inline constexpr char rules_of_thumb[] = "Rules of thumb: ";
// Displacement, force.
inline constexpr char shakes_by[] = "shakes by {} at the final speed, {} on the supports";
inline constexpr char shakes_by_together[] =
    "shakes by {} at the centre of mass at the final speed, {} on all supports together";
inline constexpr char stable_time_constant[] = "stable, slowest time constant {}";
inline constexpr char not_stable[] = "not stable by linear theory";
inline constexpr char and_with_them[] = " with them";
// Speed, times the higher critical one with balls, "that" or "the higher".
inline constexpr char final_speed[] = "; final speed {}, {:.3g} times {}";
inline constexpr char final_speed_over_highest[] = "; final speed {}, {:.3g} times the highest";
// Least to most, "side by side".
inline constexpr char balls_can_cancel[] = "; the balls can cancel {}{}";
inline constexpr char grade_without_balls[] = "; {} without balls";
inline constexpr char study_physical[] = "The study in full, in physical units";
inline constexpr char study_dimensionless[] = "The same without dimensions, as it was computed";
inline constexpr char study_in_full[] = "The study in full";

// How a result was computed.
inline constexpr char page_title[] = "Ball balancer: ";
// Method, box, drawn keys, seed, keys not taken.
inline constexpr char at_ball_angles[] = "at {} ball angles{}{}, seed {}{}";
inline constexpr char and_in_the_box[] = " and in the box of initial states";
inline constexpr char with_drawn_anew[] = ", with {} drawn anew for each";
inline constexpr char not_from_study[] = " (not from {} of the study)";
inline constexpr char speed_law[] = " Speed law: {}.";
// Which model, version, target.
inline constexpr char intervals_and_model[] =
    " Intervals hold with 95 % confidence. The model: {}, docs/explanation/equations.md. equipoise {}, {}";
inline constexpr char rotor_in_a_plane[] = "a rotor in a plane";
inline constexpr char rotor_that_tilts[] = "a rigid rotor that tilts";

// Used on several pages.
inline constexpr char how_computed[] = "How it was computed";
inline constexpr char before_varied[] = "in the study, before anything is varied";
inline constexpr char csv_holds_all[] = "the CSV file holds all of them";
inline constexpr char where_starts_end[] = "Where starts end";
inline constexpr char balanced_share_of_cells[] =
    "Balanced share of the starts in every cell, in per cent where there is room.";
// Cells done, all.
inline constexpr char cells_missing[] = "{} of {} cells are done; the rest is missing.";
// Rows, all of them, where the rest stands.
inline constexpr char table_ends[] = "The table ends after {} of {} cells; {}.";
// Key, first value, last value, values.
inline constexpr char varied_from[] = "{} from {} to {} ({} values)";

// Capacity.
inline constexpr char how_often[] = "How often it balances";
inline constexpr char what_it_balances[] = "What it balances";
inline constexpr char share_at_values[] =
    "Share of the starts that ends balanced at every value tried, with its 95 % interval.";
// Key, percentage, what starts do.
inline constexpr char largest_at_which[] =
    "The largest {} at which {:.4g} % of starts {}. A stroke is its 95 % interval: below its lower end that is shown, "
    "above its upper end it is shown to fail.";
inline constexpr char no_state_attracts[] = "no balanced state attracts";
inline constexpr char all_values_tried[] = "All values that were tried.";
inline constexpr char json_tells_all[] = "the JSON answer tells all of them";
// Key, lowest, highest, unit, finest step.
inline constexpr char values_halved[] =
    "Values of {} from {:.4g} to {:.4g}{} in steps of an eighth of that until one is shown to be too large, then "
    "halved to {:.3g}; a dip of the share between two of them would be missed. ";
// Starts, how drawn.
inline constexpr char starts_a_value[] = "{} starts a value {}, the same in all.";
inline constexpr char trials_from_file[] = "; {} trials from an earlier run's file";

// Design.
inline constexpr char margins[] = "How far each may be off";
// What it was judged on.
inline constexpr char stopped_early[] = "Stopped early: what the search had found by then, judged on {}.";
inline constexpr char before_chosen[] = "in the study, before anything is chosen";
inline constexpr char chosen_design[] = "The chosen design";
inline constexpr char could_be[] = "could be";
inline constexpr char spin_up_caption[] = "The spin-up: piecewise linear, then constant.";
inline constexpr char what_limits_it[] = "What limits it: ";
// Values, first, last.
inline constexpr char values_from[] = "{} values from {} to {}";
// Slope, unit of speed, unit of time.
inline constexpr char slope_at_most[] = ", at most {:.4g}{} a {}";
// Points, plural, lowest, highest speed, unit, last time, unit, slope.
inline constexpr char points_from[] = "{} point{} from {:.4g} to {:.4g}{} within {:.4g}{}{}{}";
inline constexpr char what_for_what[] = "Trade-offs";
inline constexpr char front_caption[] =
    "Candidates that no other beats in every objective; bars are 95 % intervals of the vertical axis.";
inline constexpr char margin_caption[] = "What becomes of it as one number moves and all others stay.";
inline constexpr char how_found[] = "How it was found";
inline constexpr char history_caption[] = "The best that was known after so many trajectories.";
// Candidates, method, how starts are drawn, trajectories, budget, seed.
inline constexpr char candidates_judged[] =
    "{} candidates by {}, all on the same starts {}; {} trajectories of {}. The front was judged on other starts, seed "
    "{}. ";
inline constexpr char ensembles_from_file[] = "; {} ensembles from an earlier run's file";
inline constexpr char design_proposed[] = "The study states no [design]; this one was proposed and taken";
inline constexpr char chosen_as_study[] = "The chosen design as a study";

// One machine: headings.
inline constexpr char rotor_alone[] = "The rotor alone";
inline constexpr char in_the_study[] = "in the study";
inline constexpr char what_to_change[] = "What to change";
inline constexpr char how_it_shakes[] = "How it shakes";
inline constexpr char how_it_shakes_on_the_way[] = "How it shakes on its way up";
inline constexpr char limits_and_standards[] = "Limits and standards";
inline constexpr char on_the_way[] = "On the way";

// One machine: where starts end.
inline constexpr char stopped_machine[] = "Stopped early: all figures are of the starts that were done.";
inline constexpr char all_starts[] = ", all starts";
inline constexpr char speed_over_time[] = "Speed over time";
inline constexpr char ends_caption[] =
    "Bars: shares of starts with 95 % intervals. Circles: left, the balls in the race as seen from the turning rotor, "
    "with a wedge at its heavy side and arrows where balls move; right, the path of the rotor's centre as seen from "
    "beside the machine, all to one scale";
// The same of a rotor that tilts. Where: at_a_bearing, at_centre_of_mass.
inline constexpr char ends_caption_of_tilt[] =
    "Bars: shares of starts with 95 % intervals. Circles: left, the balls in their races as seen from the turning "
    "rotor, "
    "that with the largest place along the shaft outermost, with arrows where balls move; right, the path of the shaft "
    "{}, as seen from beside the machine, all to one scale";
inline constexpr char at_a_bearing[] = "at the outermost bearing that moves more";
inline constexpr char at_centre_of_mass[] = "at the centre of mass";
inline constexpr char limit_dashed[] = ", the limit dashed if it lies within the drawing.";
inline constexpr char rarer_not_drawn[] = " {} rarer not drawn.";
inline constexpr char first_starts_only[] = " Peaks and runs are of the first {} starts.";
inline constexpr char ends_table_caption[] =
    "Displacement and velocity at the end, means over the starts of the outcome";
inline constexpr char grade_to_compare[] =
    "; balance quality: ISO 21940-11's grade of the unbalance that is left, for comparison only";
inline constexpr char grade_in_planes[] =
    "; balance quality: ISO 21940-11's grade of the unbalance that is left in the plane of the outermost bearing that "
    "has more of it for its share, for comparison only";

// One machine: a motion.
inline constexpr char centre_on_axis[] = "The centre rests on the axis";
inline constexpr char centre_is[] = "The centre is ";
// Place of a bearing.
inline constexpr char shaft_on_axis[] = "At {} the shaft rests on the axis";
inline constexpr char shaft_is[] = "At {} the shaft is ";
inline constexpr char off_the_axis[] = " off the axis";
inline constexpr char drawn_from_one[] = " Drawn from the end of one start.";
inline constexpr char one_of_continuum[] = " One of a continuum of such motions.";
inline constexpr char rests_in_race[] = "rests in the race";
inline constexpr char rest_in_race[] = "rest in the race";
inline constexpr char swings_about_place[] = "swings about its place";
inline constexpr char swing_about_places[] = "swing about their places";
inline constexpr char the_ball[] = "the ball ";
inline constexpr char the_balls[] = "the balls ";

// One machine: runs and figures on the way.
inline constexpr char runs_caption[] =
    "Distance of the rotor's centre from its place at rest; shaded: swings too fast to be drawn.";
inline constexpr char runs_caption_at_bearings[] =
    "Distance of the shaft from its place at rest, at the bearing where it is largest; shaded: swings too fast to be "
    "drawn.";
inline constexpr char bare_rotor_is_typical[] = " Without balls: the rotor of the typical start.";
// Separator, number, typical or worst.
inline constexpr char start_is[] = "{}start {} is the {}";
inline constexpr char typical_one[] = "typical one";
// Peak.
inline constexpr char followed_again[] = " (followed again with smaller steps, {} within what is shown)";
// Caption, which starts are shown.
inline constexpr char of_this_seed[] = "{} With this seed, {}.";
inline constexpr char all_starts_title[] = "all starts";
inline constexpr char exceeded_by[] = "exceeded by";
inline constexpr char no_balls_one_run[] = "No balls: one run of the same rotor. ";
inline constexpr char no_balls_median[] = "No balls: median of the first starts' rotors. ";
inline constexpr char settled_means[] = "Settled: displacement below {}.";
// Sag.
inline constexpr char measured_from_rest[] =
    " Displacements are measured from where the rotor rests, {} below its unloaded springs; forces include its weight.";
// Starts, how drawn, longest time.
inline constexpr char starts_followed[] =
    "{} starts {}, each followed until it is known where it ends (undecided after {}). ";
inline constexpr char starts_from_file[] = "; {} starts from an earlier run's file";

// A map.
inline constexpr char stopped_map[] =
    "Stopped before all points were done: white ones are missing, shares are of the others.";
inline constexpr char plays_no_part[] = "in the study; its values of what varies here are not used";
// Axes, angles that stay.
inline constexpr char start_at_every_point[] = "One start at every point: {}; {}{}. Darker pixels were decided later.";
inline constexpr char one_of_points[] = " One of {0} x {0} points is drawn.";
inline constexpr char of_the_points[] = "of the points";
inline constexpr char points_on_grid[] = "Points lie on a grid; the interval is that of as many random ones.";
inline constexpr char how_basins_lie[] = "how basins lie in each other";
inline constexpr char box_dimension[] = "box dimension of the boundary (1: smooth, 2: it fills the plane)";
inline constexpr char uncertainty_exponent[] = "uncertainty exponent (near 0: exact starts help little)";
inline constexpr char boundary_entropy[] = "boundary basin entropy (above 0.693: fractal)";
// Points across, points up.
inline constexpr char points_followed[] = "{} x {} points, a start each, followed until it is known where it ends.";
inline constexpr char points_from_file[] = "; {} points from an earlier run's file";

// A sweep.
inline constexpr char lost_starts[] = "{} starts could not be followed to an end.";
// Cells, plural, note.
inline constexpr char note_of_cells[] = "Note of {} cell{}: {}.";
inline constexpr char more_notes[] = "{} more notes of single cells.";
inline constexpr char stacked_caption[] = "Shares of starts, stacked; strokes: 95 % interval of the balanced share.";
inline constexpr char peak_on_the_way[] = "Peak displacement on the way";
inline constexpr char peaks_along[] = "Peaks along the parameter";
inline constexpr char with_intervals[] = "With 95 % intervals.";
// Values, key.
inline constexpr char more_not_drawn[] = " {} more values of {} are not drawn.";
inline constexpr char bounds_hold[] =
    "Intervals hold only if the undecided starts end elsewhere; bounds hold however they end.";
// In a cell.
inline constexpr char least_to_most_starts[] = "{} to {} starts";
// Cells, starts each, starts in all, how drawn.
inline constexpr char cells_followed[] =
    "{} cells with {} each ({} in all) {}, the same in every cell, each followed until it is known where it ends.";
inline constexpr char sampled_until[] = " Sampled until every share was known to +- {:.3g} %.";
inline constexpr char cells_from_file[] = "; {} cells from an earlier run's file";

}  // namespace equipoise::words::pages
