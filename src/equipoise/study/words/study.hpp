// A study that cannot be read, and how to put it right: tables, keys, values, distributions, starts.
// This room: the sentences of this chapter.
#pragma once

namespace equipoise::words::study {

// Files and overrides.
inline constexpr char file_unreadable[] = "cannot be read ({}); must be a readable study file (TOML)";
inline constexpr char results_file[] = "NetCDF, a file of results: \"equipoise inspect\" reads it";
inline constexpr char one_toml_value[] = "must be a single TOML value";
inline constexpr char key_equals_value[] = "must be key=value, for example rotor.eccentricity=0.02";
inline constexpr char more_parts_than_any_key[] = "unknown key: more parts than any key of a study has";
inline constexpr char table_of_tables[] = "must be a table of tables, [rotor] and the others of a study";
// Key, three times, and number of entries.
inline constexpr char entries_of_array[] = "{} has entries {}.1 to {}.{}";

// Keys.

// Hint, what must be there.
inline constexpr char missing[] = "missing{}; must be {}";
inline constexpr char meant_for_it[] = " (is \"{}\" meant for it?)";
// Hint, all keys of the table.
inline constexpr char unknown_key[] = "unknown key{} (allowed: {})";
inline constexpr char did_you_mean[] = "; did you mean \"{}\"?";
inline constexpr char key_of_other_table[] = "; [{}] has a key of this name";
inline constexpr char either_or[] = "give either {} or {}, not both";

// Values: kinds.

// What it is, what it must be.
inline constexpr char kind_of_value[] = "is {}; must be {}";
inline constexpr char must_be_text[] = "is {}; must be a text in quotes";
inline constexpr char must_be_flag[] = "is {}; must be true or false";
inline constexpr char must_be_texts[] = "is {}; must be an array of strings";
inline constexpr char entry_must_be_text[] = "has an entry that is {}; must be an array of strings";
inline constexpr char whole_number[] = "a whole number from {} to {}";
inline constexpr char no_point_or_exponent[] = "must be {}, without point or exponent";
inline constexpr char at_most_in_size[] = ", at most {} in size";

// Values: arrays.
inline constexpr char array_of_numbers[] = "an array of numbers";
// What an entry must be.
inline constexpr char array_of[] = "an array, each entry {}";
// What an entry must be.
inline constexpr char must_be_array_of[] = "must be an array, each entry {}";
// What one must be, number of entries, what an entry belongs to.
inline constexpr char one_or_each[] = "{}, or an array of {}, one per {}";
// Number of entries, then as in one_or_each.
inline constexpr char entries_for_each[] = "has {} entries; must be {}, or an array of {}, one per {}";
// Number of entries, form: "[low, high]".
inline constexpr char two_numbers[] = "has {} entries; must be two finite numbers, {}";
inline constexpr char only_of_tilt[] = "has a meaning only with rotor.tilt";
inline constexpr char tilt_needs_planes[] =
    "missing; rotor.tilt needs the place of each ball's race along the shaft, a number, or an array, one per ball";
inline constexpr char not_with_tilt[] =
    "no rotor with rotor.tilt has this: its balls slide in a centred race and pass each other";
// Key: rolls or contact.
inline constexpr char not_with_tilt_unless[] =
    "no rotor with rotor.tilt has balls that roll or touch: state balancer.{} = false";
inline constexpr char no_such_body[] = "must be at most twice rotor.tilt.transverse_inertia: no body has more";
inline constexpr char stiffness_not_definite[] =
    "must be [k12, k22] with k22 greater than 0 and k12^2 less than {0} k22, where {0} is rotor.stiffness";
inline constexpr char damping_not_definite[] =
    "must be [c12, c22] with c22 at least 0 and c12^2 at most {0} c22, where {0} is rotor.damping";
inline constexpr char most_bearings[] = "must have at most {} places where each bearing's stiffness is stated";
inline constexpr char one_or_two_a_bearing[] =
    "must be an array of {} numbers, one a bearing of rotor.tilt.bearings_at, or of {}, of each in X and Y in turn";
inline constexpr char not_the_supports[] =
    "must add up, with its moments about the centre of mass, to rotor.{0} and rotor.tilt.{0}";
inline constexpr char of_tilt[] = "[of a deflection and a tilt, of a tilt], or { x = [..], y = [..] }";
inline constexpr char bounds_out_of_order[] = "bounds out of order; must be [low, high] with low at most high";

// Quantities, in a study in physical units.

// What it must be, the physical key that is given.
inline constexpr char mass_makes_it_physical[] = "missing; must be {}, for {} makes this a study in physical units";
// What it is, what it must be.
inline constexpr char quantity_needed[] = "is {} and rotor.mass makes this a study in physical units; must be {}";
inline constexpr char mass_states_physical[] = " (a study in physical units states rotor.mass)";
// What it must be, smallest, largest.
inline constexpr char size_in_si[] = "must be {}; its size in SI units must be {} to {}";
inline constexpr char one_quantity[] = "is an array; must be one quantity";
inline constexpr char units_of_dimensionless_study[] =
    "belongs to a dimensionless study; here the units follow from rotor.mass, balancer.race_radius and rotor.stiffness";
// Lowest and highest in s, then in 1/omega_c.
inline constexpr char horizon[] = "must be a time from {:.6g} s to {:.6g} s ({} to {} times 1/omega_c)";
inline constexpr char no_units[] = "missing; a dimensionless study is shown in physical units by [units]";

// Distributions. The first {} of an entry is the name of the distribution.
inline constexpr char distribution_forms[] =
    "{ uniform = [low, high] }, { normal = [mean, standard deviation] }, { loguniform = [low, high] } or { values = "
    "[..] }, each entry equally likely";
inline constexpr char or_a_distribution[] = ", or a distribution, {}";
inline constexpr char two_distributions[] = "has two distributions; must be one of {}";
inline constexpr char unknown_entry_of_distribution[] = "has an unknown entry \"{}\"; must be {}";
inline constexpr char distribution_of_numbers[] = "{} must be an array of numbers";
// Name of the distribution, place of the entry.
inline constexpr char entry_without_number[] = "{} entry {} does not begin with a number";
inline constexpr char entry_without_unit[] = "{} entry {} has no unit; must be a number, or a number with a unit";
inline constexpr char entry_no_number[] =
    "{} entry {} is not a number; must be a finite number, or a quantity with its unit";
inline constexpr char entry_of_other_unit[] =
    "{} entry {} has another unit than the entries before; all must have the same unit";
// Name of the distribution, number of entries, form: "[low, high]".
inline constexpr char two_entries[] = "{} has {} entries; must have two, {}";
inline constexpr char negative_deviation[] = "the standard deviation must be 0 or more";
inline constexpr char distribution_out_of_order[] = "{} bounds out of order; must be [low, high] with low at most high";
inline constexpr char loguniform_above_0[] = "loguniform bounds must be greater than 0";
inline constexpr char between_of_normal[] = "between can be used only with normal";
inline constexpr char between_two_numbers[] = "between must be two numbers, [low, high] with low less than high";
inline constexpr char between_far_from_mean[] = "between must begin or end within {} standard deviations of the mean";
inline constexpr char draws_of_changed_study[] =
    "was changed after it was read, which its draws in physical units would not show; must be changed by overrides, or "
    "after with_medians()";

// Release, start and sampling.
inline constexpr char speed_or_time_of_release[] = "give either release.speed or release.time, not both";
inline constexpr char clamped_balls_have_no_rate[] = "must be 0: the balls are clamped until their release";
inline constexpr char box_needs_free_balls[] =
    "needs balls that are free from t = 0, but their release is at t = {} (clamped balls share one spin-up); set "
    "release.time = 0 or leave [sampling.box] out";
inline constexpr char grid_of_one[] = "must be 2 or more: a grid has two starts in every cell";

// Limits and standards.
inline constexpr char standards_need_units[] = "a study in physical units, or with [units]";
inline constexpr char unbalance_without_planes[] =
    "is judged in the planes of two bearings, which rotor.tilt does not state: without them it would leave out the "
    "couple unbalance; state rotor.tilt.bearings_at, or in physical units rotor.tilt.bearings";
inline constexpr char force_of_more_bearings[] =
    "is of the bearing that takes most, and of more than two bearings each has to be known: state "
    "rotor.tilt.bearings_stiffness and rotor.tilt.bearings_damping, or in physical units rotor.tilt.bearings";
inline constexpr char force_of_one_or_all[] =
    "is of the bearing that takes most, but beside standards.standing_mass only the force on all together is known; "
    "state one of the two";
inline constexpr char needs_settled[] = "needs limits.settled, the displacement below which the rotor has settled";
inline constexpr char weighted_by_hertz[] =
    "is weighted by the frequency in Hz, which needs a study in physical units, or with [units]";
inline constexpr char grade_needs_units[] =
    "is a grade, which needs a study in physical units; must be U/M in R, or state `grade`";
inline constexpr char grade_given_twice[] = "is a grade too; give either limits.grade or this, not both";
inline constexpr char grade_of_residual[] =
    "must be \"G\" and a number of mm/s greater than 0, such as \"G 6.3\", or an unbalance";

}  // namespace equipoise::words::study
