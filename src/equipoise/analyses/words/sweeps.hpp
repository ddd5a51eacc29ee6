// Sweeps, capacities, maps and attractors along a parameter: what an axis must be, which files fit.
#pragma once

namespace equipoise::words::sweeps {

// Axes of a sweep.
inline constexpr char axis_form[] =
    "must be KEY=FROM:TO:STEP or KEY=A,B,C in numbers, e.g. speed.final=1.5:6:0.1, or in quantities of one unit, e.g. "
    "\"speed.final=900 rpm:4000 rpm:100 rpm\"";
inline constexpr char mixed_units[] = "mixes the units \"{}\" and \"{}\"; must be one";
inline constexpr char varied_twice[] = "is varied twice; must be named once";
inline constexpr char repeats_on_zipped_axis[] =
    "has a value twice; the first of parameters that vary together is the axis, and must have different ones";
inline constexpr char repeats[] = "has a value twice; must be different ones";
// Values of this key, the plural s, another key, its values.
inline constexpr char zipped_sizes[] = "has {} value{}, {} has {}; zipped parameters must have as many each";
inline constexpr char too_many_cells[] = "makes more than {} cells; must be fewer";
inline constexpr char number_of_axes[] = "must be 1 to {} parameters, or more that vary together";
inline constexpr char shard_range[] = "must be less than the number of shards";

// Files and messages of a sweep.
inline constexpr char no_sweep_named[] = "does not say which sweep it is of";
inline constexpr char no_files[] = "must be at least one file of a sweep";
// The first file, the difference.
inline constexpr char cell_beyond[] = "is damaged: it holds a cell {} of a sweep of {} cells";
inline constexpr char another_sweep[] = "is of another sweep than {}: {}";

// What a capacity is of, and in which range. The first: a comment in a study.
inline constexpr char all_together[] = "# all unbalances in proportion\n";
inline constexpr char states_another_key[] = "the study states {0}; must be {0}, or another key";
// A key.
inline constexpr char couple_alone[] =
    "the rotor's unbalance is a couple alone, which no static unbalance measures; must be another key, such as --of {} "
    "with its range, --between LOW:HIGH";
inline constexpr char unbalance_varies[] =
    "an unbalance of this rotor that tilts is drawn or varied besides; must be another key, such as --of {} with its "
    "range, --between LOW:HIGH";
inline constexpr char range_missing[] =
    "must be given as LOW:HIGH for this key (only rotor.eccentricity, and rotor.unbalance of a study in physical "
    "units, have a default range)";
inline constexpr char range_form[] =
    "must be LOW:HIGH, two numbers or quantities of one unit, the first below the second, e.g. 0.001:0.1 or \"20 g "
    "mm:400 g mm\"";
inline constexpr char must_rise[] = "must have its lower end first";
inline constexpr char share_range[] = "must be between 0 and 1";
inline constexpr char precision_range[] = "must be from 0.0001 to 0.1";
inline constexpr char one_of[] = "must be one of: {}";
inline constexpr char no_such_limit[] = "no such limit";

// Attractors along a parameter.
inline constexpr char line_form[] =
    "must be KEY=FROM:TO:STEP with three numbers, e.g. speed.final=1.4:6.5:0.05; in a study with units also "
    "quantities, e.g. \"speed.final=900 rpm:4000 rpm:50 rpm\"";
// The form.
inline constexpr char line_key[] =
    "KEY must be a key of rotor, balancer or speed that takes a number, or speed.final; {}";
inline constexpr char data_sheet_key[] =
    "is a key of data sheets; this command varies what they become, such as rotor.eccentricity, balancer.mass and "
    "balancer.drag; \"equipoise sweep\" reads the whole study anew for each value, and takes any key";
inline constexpr char inertia_of_a_couple[] =
    "here only the inertia would change and the angle of the couple unbalance stay, so that another couple would act; "
    "\"equipoise sweep\" reads the whole study anew for each value";
inline constexpr char nothing_turns[] = "nothing turns; the final speed must not be 0";
inline constexpr char values_searched[] = "values searched";
inline constexpr char branches_followed[] = "branches followed";

// Axes and pixels of a map.
inline constexpr char pixels_range[] = "pixels; must be a whole number from 1 to {}";
inline constexpr char rising_range[] = "must be two finite numbers, the first below the second";
inline constexpr char same_key_twice[] = "both axes vary the same key; must be two";
// The other axis.
inline constexpr char set_by_other_axis[] = "varies nothing: {}, the other axis, sets the same quantity";
// An example.
inline constexpr char range_of_axis[] = "must be LOW:HIGH with two numbers, the first below the second, e.g. {}";
inline constexpr char example_with_units[] = "1.5:6, or two quantities with units";
// Key, what is allowed.
inline constexpr char quantities_without_scales[] = "the study is dimensionless, and quantities need scales; {}";
inline constexpr char key_without_quantities[] =
    "{} takes no quantities here, for the balls' masses differ; must be two plain numbers";
inline constexpr char key_of_dimensionless_study[] =
    "{} takes no quantities here; must be another key, as rotor.eccentricity with millimetres";
inline constexpr char size_form[] = "must be WIDTHxHEIGHT, each a whole number from 1 to {}, e.g. 512x512";
inline constexpr char tie_form[] = "must be phi_I=phi_J or phi_I=phi_J+ANGLE, e.g. phi_2=phi_1+pi";
inline constexpr char tie_balls[] = "must name two different balls from 1 to {}";
// Ball, one of the two below.
inline constexpr char tied_already[] = "ball {} has its angle from {}; must be another ball";
inline constexpr char an_axis[] = "an axis";
inline constexpr char another_tie[] = "another tie";
inline constexpr char line_needs_validated[] =
    "along a parameter every pixel is followed until it is seen to approach a motion; must be \"validated\"";
inline constexpr char too_many_in_memory[] =
    "pixels; more than {:.1f} million in all (4096x4096) must go to an output file";
inline constexpr char balls_would_overlap[] = "balls would overlap, or failed";

// Files of maps.
inline constexpr char this_map[] = "this map";
inline constexpr char same_map[] = "must be a new file, or one of the same map";
inline constexpr char pixel_without_name[] = "the map is damaged: a pixel has outcome {}, which it does not name";
inline constexpr char other_size[] = "is damaged: it has another number of pixels";

// Progress.
inline constexpr char line_motions[] = "motions along the lines of the map";

// What part files of maps name these notes by: with other words, they are computed again.
inline constexpr char line_notes[] = "motions along the lines of a map";

}  // namespace equipoise::words::sweeps
