// Files of results: what is in them, and why they cannot be read, written or carried on.
// This room: the sentences of this chapter.
#pragma once

namespace equipoise::words::files {

// Whether a file can be written.
inline constexpr char is_a_folder[] = "is a folder";
inline constexpr char is_no_folder[] = "{} is not a folder";
inline constexpr char no_such_folder[] = "the folder {} does not exist";
inline constexpr char must_be_writable[] = "{}; must be a file that can be written";
inline constexpr char file_must_be_writable[] = "{}: {} (must be a file that can be written)";
inline constexpr char no_regular_file[] = "is no regular file; {}";
inline constexpr char replaceable[] = "must be a file that can be replaced";
inline constexpr char unfinished_results_beside[] =
    "has unfinished results beside it, {}; must be another file, or finish those first";
inline constexpr char written_by_another[] =
    "is being written by another process; must be a file that no other run writes to";

// Whether a file is what it should be. Before a colon: its path.
inline constexpr char no_results_or_damaged[] =
    "is not a file of results (.nc, .nc.part), or is damaged; must be another file";
inline constexpr char results_of_other_version[] =
    "is not a file of results of this version: an earlier one wrote it, it was changed or cut short, or it is "
    "something else";
inline constexpr char checksum_differs[] = "is damaged: its content does not match its checksum";
inline constexpr char owner_is_damaged[] = "is damaged in the part that names its results; remove it first";
// Why, one of those below or the system's words.
inline constexpr char results_or_unfinished_part[] =
    "cannot be read ({}); must be a file of results (.nc), or its unfinished part (.nc.part)";
inline constexpr char not_a_regular_file[] = "not a regular file";
inline constexpr char damaged_within_sound[] =
    "{} bytes are damaged or cut off; all other records are sound and will be used";
// File, bytes.
inline constexpr char damaged_bytes[] =
    "{}: {} bytes are damaged or cut off; all other records are used, and what is lost is computed again";
// The sentence above, or the file and a colon; number of starts, the first of them.
inline constexpr char lost_starts[] = "{} {} starts are missing, from number {} on";
inline constexpr char variable_of_other_shape[] = "{}: variable {} has the wrong type or shape";
inline constexpr char longer_than_file[] = "{}: {} is longer than the file";
inline constexpr char unreadable_netcdf[] = "{}: cannot be read: {}";
// Why a header of NetCDF is none.
inline constexpr char no_classic_netcdf[] = "it is not a classic NetCDF file";
inline constexpr char header_cut_off[] = "its header is cut off";
inline constexpr char header_count_too_large[] = "its header has a count that is too large";
inline constexpr char header_of_other_parts[] = "its header has parts that the format does not know";
inline constexpr char header_beyond_end[] = "a variable goes beyond its end";
// Why a record is none, behind its place.
inline constexpr char damaged_within[] = "is damaged ({})";
inline constexpr char record_of_cell[] = "is damaged: record {}: {}";
inline constexpr char no_record[] = "is not a record";
inline constexpr char too_deep[] = "is nested too deeply";
inline constexpr char absent[] = "is missing";
inline constexpr char no_members[] = "has no members";
inline constexpr char no_entries[] = "has no entries";
inline constexpr char no_list[] = "is no list";
inline constexpr char no_text[] = "is no text";
inline constexpr char no_truth[] = "is neither true nor false";
inline constexpr char no_number[] = "is no number";
inline constexpr char no_integer[] = "is no integer";
inline constexpr char not_in_range[] = "is out of range: {}";
inline constexpr char wrong_length[] = "has {} entries instead of {}";
inline constexpr char changed_by_another[] = "{}: another program has changed this file; nothing more is kept in it";
inline constexpr char outcome_without_name[] = "is damaged: start {} has outcome {}, which the file does not name";
// The finished file.
inline constexpr char start_is_missing[] = "{}: start {} is not there";
inline constexpr char start_without_outcome[] = "{}: start {} has no valid outcome; the file is damaged";
// What is wrong.
inline constexpr char finished_basin[] = "{}; must be a result that \"basin -o\" finished";
inline constexpr char no_starts[] = "holds no starts";
inline constexpr char other_command[] = "holds no {0}; must be what \"{0} -o\" wrote";

// Whether it holds the same results.
inline constexpr char same_study_or_new[] = "must be a new file, or results of the same study";
inline constexpr char same_results_or_new[] = "must be a new file, or results of the same {}";
inline constexpr char something_else[] = "holds something else";
inline constexpr char results_of_this_study[] = "results of this study";
// What it should hold, how they differ, what it must be.
inline constexpr char other_results[] = "holds something other than {}: {}; {}";
// Empty or ", ", key, its value in the file and in the study.
inline constexpr char differs[] = "{}{} is {} there and {} here";
inline constexpr char and_more_differences[] = ", and {} more";
inline constexpr char header_differs[] = "its header has a different format";

// What a broken run leaves.

// Why it broke.
inline constexpr char kept_so_far[] = "{}; what was computed before is kept, and the same command goes on from it";
// Why it broke, the output.
inline constexpr char kept_in_part[] = "{}; what was computed is kept in {}.part and put in place by the same command";

// Titles of files.
inline constexpr char basins[] = "Basins of a rotor with an automatic ball balancer";
inline constexpr char attractors_along[] = "Attractors of a rotor with an automatic ball balancer along a parameter";
inline constexpr char over_a_plane[] = "Where a rotor with an automatic ball balancer ends, over a plane";
inline constexpr char over_parameters[] = "Where a rotor with an automatic ball balancer ends, over parameters";
inline constexpr char trajectory[] = "Trajectory of a rotor with an automatic ball balancer";
inline constexpr char design[] = "Design: candidates, and those that no other beats";
// Key, share, what the starts do.
inline constexpr char capacity[] = "Largest {} at which a share of {} of the starts {}";

// Outcomes, and their shares.
inline constexpr char name_of_outcome[] = "name of the outcome";
inline constexpr char name_by_wright_and_peng[] = "name that Wright and Peng (2019) give it";
inline constexpr char starts_with_outcome[] = "starts with the outcome";
inline constexpr char code_of_attractor[] =
    "identifier of an attractor, the same in all cells; 0 undecided, negative: lost or stalled";
inline constexpr char interval_from[] =
    "where the interval is from: wilson, replicates (their spread) or pairs (of a cell)";
inline constexpr char effective_starts[] = "independent random starts that have the same standard error of the share";
inline constexpr char lower_end[] = "lower end of its 95 % interval";
inline constexpr char upper_end[] = "upper end of its 95 % interval";

// Starts.
inline constexpr char index_of_start[] = "index of the start";
inline constexpr char number_of_ball[] = "number of the ball";
inline constexpr char state_met_in_run[] =
    "state on a motion first met during the run: x, y, u, v, phi, phi_dot, and of driven rotors what turns them";
inline constexpr char start_that_met_motion[] = "start that first met a motion";
inline constexpr char key_of_study[] = "key of the study";
inline constexpr char unit_of_drawn[] = "unit of its values in drawn";

// Unbalance that dry friction leaves.
inline constexpr char share_of_starts_of_outcome[] = "share of an outcome's starts";
inline constexpr char unbalance_left[] =
    "unbalance that so many of the starts leave, or less, where dry friction holds the balls, in M R";
inline constexpr char unbalance_left_in_percent[] =
    "unbalance that {:.0f} % of the starts leave, or less, where dry friction holds the balls, in M R";
inline constexpr char grade_left[] = "balance quality grade of that (ISO 21940-11), at the operating speed";

// Transients, limits, and the rotor without balls.
inline constexpr char within_all_limits[] = "when a start is within all limits: at_end, on_the_way, both";
inline constexpr char what_rotor_carries[] = "what the rotor carries";
inline constexpr char no_balls[] = "no balls";
inline constexpr char balls_held[] = "balls held where they start";
inline constexpr char column_of_transients[] = "column of the starts' transients";
inline constexpr char share_of_runs_below[] = "share of runs that have less";
inline constexpr char runs_stalled[] = "of these, that stalled";
inline constexpr char mean_of_runs[] =
    "mean of the figure over runs in which it is finite, dimensionless as in its column";
inline constexpr char quantile_of_runs[] =
    "quantile of the figure over runs, dimensionless as in its column; infinite where it has no end, missing where it "
    "was not asked";

// Before the name of a figure of transients.
inline constexpr char quantile_over_starts[] = "quantile over starts: ";
inline constexpr char lower_end_of[] = "lower end of its 95 % interval: ";
inline constexpr char upper_end_of[] = "upper end of its 95 % interval: ";

// Shares of starts by limits.
inline constexpr char share_above_limit[] = "share of starts above limits.{}";
inline constexpr char share_keeping_limits[] = "share of starts that keep all limits: {}";

// Maps.
inline constexpr char share_of_pixels[] = "share of the map's pixels";
inline constexpr char state_met_at_pixel[] =
    "state on a motion first met at a pixel: x, y, u, v, phi, phi_dot, and of driven rotors what turns them";
inline constexpr char outcome_of_pixel[] = "what the pixel's start comes to";
// Key, lowest, highest, pixels.
inline constexpr char axis_of_map[] = "{} from {} to {} in {} pixels";

// Attractors along a parameter.
inline constexpr char id_along_range[] = "identifier, the same along the whole range";
inline constexpr char name_of_attractor[] = "name of the attractor";
// Flags, a word each.
inline constexpr char kinds_of_motion[] = "equilibrium periodic quasi-periodic chaotic";
inline constexpr char whether_it_attracts[] = "whether the motion attracts its neighbourhood";
inline constexpr char drift_of_ball[] = "mean rate of a ball in the rotating frame, radians times omega_c";
inline constexpr char attractor_of_event[] = "identifier of the attractor to which it happens";
inline constexpr char type_of_bifurcation[] = "type of the bifurcation";
inline constexpr char above_parameter[] = "it happens above this value of the parameter";
inline constexpr char below_parameter[] = "it happens below this value of the parameter";

// Capacities: the cell, then its trials.

// Key, share, what the starts do.
inline constexpr char capacity_of_cell[] = "{}: the largest at which a share of {} of the starts {}";
inline constexpr char share_still_kept[] = "{}: up to here the share is as large with 95 % confidence";
inline constexpr char share_lost[] = "{}: here the share is smaller with 95 % confidence";
inline constexpr char kept_in_whole_range[] = "1: the share is as large up to the end of the range";
inline constexpr char lost_in_whole_range[] = "1: the share is smaller over the whole range";
inline constexpr char share_balanced[] = "share of the starts that end balanced";
inline constexpr char share_undecided[] = "share of the starts that stay undecided";
inline constexpr char trial_unstable[] = "1: no balanced state attracts, and no start was followed";

// Sweeps, designs, and all that the program keeps of a cell.
inline constexpr char stable_state_exists[] = "1: a linearly stable balanced state exists";
inline constexpr char candidate[] = "starts, seed and values of the candidate";
inline constexpr char front_of_search[] = "of the front, on the starts of the search";
inline constexpr char front_held_out[] = "of the front, on held-out starts";
inline constexpr char records_of_cells[] = "all that is known of every cell, for the program (CBOR)";
inline constexpr char ends_of_records[] = "where in record a cell ends, in bytes";

// Facts that `equipoise inspect` tells.
inline constexpr char search_steps[] = "steps of the search";

}  // namespace equipoise::words::files
