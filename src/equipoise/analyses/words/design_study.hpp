// What is wrong with [design] of a study, and the [design] that is proposed where there is none.
#pragma once

namespace equipoise::words::design_study {

// Requirements, method and budget.
inline constexpr char must_be_a_table[] = "must be a table, [{}]";
inline constexpr char must_be_a_bound[] = "must be { below = NUMBER } or { above = NUMBER }";
inline constexpr char must_be_plain[] = "must be a plain number";
inline constexpr char must_be_in_unit[] = "must be in {}, or a unit like it";
inline constexpr char met_by_nothing[] = "cannot be met; above must be less than below";
inline constexpr char met_by_no_share[] = "cannot be met by a share; must be between 0 and 1";
inline constexpr char method_for_one[] = "has one objective; must be nsga2 for several";
inline constexpr char method_for_several[] = "wants several objectives; must be cmaes for one";
inline constexpr char needs_pagmo[] =
    "needs pagmo2 (libpagmo-dev), without which this program was built; must be random, latin or grid";
inline constexpr char budget_too_small[] =
    "is too small a budget; must be at least {}, twenty first looks at {} starts";

// Figures.
inline constexpr char names_twice[] = "names {} twice";
inline constexpr char must_be_figures[] = "must be an array of 1 to {} figures, such as [\"balanced\"]";
inline constexpr char work_unknown[] =
    "must be another figure: at a prescribed speed the work that collisions and dry friction take is not known (of a "
    "motor, profile \"torque\", it is)";
inline constexpr char needs_inertia[] =
    "needs rotor.inertia, which a change of speed has to work against; must be stated in the study";
inline constexpr char must_end_in_quantile[] =
    "must end in a quantile between 0 and 1: \"{0}.0.5\", the median, or \"{0}.0.95\"";
inline constexpr char needs_settled[] = "needs limits.settled; must be stated in the study";
inline constexpr char needs_displacement[] = "needs limits.displacement; must be stated in the study";
inline constexpr char needs_limits_on_the_way[] =
    "needs limits.displacement, force or clearance; must be stated in the study";
inline constexpr char needs_limits[] = "needs [limits]; must be stated in the study";
// Figures of this drive, columns.
inline constexpr char must_be_a_figure[] =
    "must be balanced{}, limits_kept, ball_mass, a quantile over starts such as \"peak_radial.0.95\" (of {}), or a key "
    "of [design.vary], with - before it if less is better";
inline constexpr char figures_of_a_motor[] = ", passed";
inline constexpr char figures_of_a_spin_up[] = ", spin_up_time, acceleration";

// What may be varied: keys and their entries. Tables of a machine; an unknown entry, `forms`; entry, what it must be.
inline constexpr char set_by_another[] = "cannot be varied beside {}, which sets it too";
inline constexpr char too_many_numbers[] =
    "has {} numbers to choose; must be 1 to {} (a spin-up counts as two per point and one more)";
inline constexpr char must_be_a_key[] =
    "must be a key of {}, in quotes, such as \"balancer.mass\", or \"speed\", a spin-up";
inline constexpr char drawn_with_each_start[] =
    "is drawn with each start of this study; must be a plain value there to be chosen";
inline constexpr char forms[] =
    "must be [low, high], { range = [low, high], scale = \"log\", digits = 2 }, { range = [low, high], step = STEP }, "
    "{ choices = [..] }, { stock = [low, high] }, or for \"speed\" { points = 2, until = 500.0, range = [0.0, 3.0], "
    "slope = 0.05 }; keys of a study stand in quotes";
inline constexpr char unknown_entry[] = "has an unknown entry \"{}\"; {}";
inline constexpr char entry_must_be[] = "{} must be {}";
inline constexpr char a_number[] = "a number";
inline constexpr char few_digits[] = "1, 2 or 3";
inline constexpr char a_whole_number[] = "a whole number";
inline constexpr char a_time[] = "a time";
inline constexpr char a_slope[] = "a change of speed in a time";

// Ranges.
inline constexpr char must_be_whole[] = "must have whole numbers at both ends";
inline constexpr char must_be_numbers[] = "must have numbers, or quantities with their units, at both ends";
inline constexpr char mixes_units[] = "mixes the units \"{}\" and \"{}\"; must be one";
inline constexpr char reversed[] = "is reversed or empty; the first end must be below the second";
inline constexpr char must_be_log_or_linear[] = "scale must be \"log\" or \"linear\"";
inline constexpr char must_begin_above_zero[] = "must begin above 0 where the scale is \"log\"";

// Choices.
inline constexpr char must_be_choices[] = "choices must be an array of two or more values";
inline constexpr char wrong_choice[] = "choices must be numbers, quantities or words";
inline constexpr char has_twice[] = "has {} twice";
inline constexpr char too_few_values[] = "leaves fewer than two values to choose from; must have a wider range";

// Rounding.
inline constexpr char step_out_of_range[] = "step must be greater than 0 and leave {:.0f} values at most";
inline constexpr char must_be_few_digits[] = "digits must be 1, 2 or 3";
inline constexpr char must_begin_at_zero[] = "must begin at 0 or above where digits are given";
inline constexpr char too_many_values[] = "has too many values with so many digits";
inline constexpr char step_or_digits[] = "must give either step or digits";
inline constexpr char whole_anyway[] = "is of whole numbers anyway; step and digits are of others";
inline constexpr char step_in_another_unit[] = "step must have the unit of the range, \"{}\"";

// Stock sizes. Smallest and largest in mm.
inline constexpr char must_be_two_lengths[] = "stock must have two lengths, such as [\"6 mm\", \"12 mm\"]";
inline constexpr char must_be_two_classes[] =
    "stock must have two classes of ISO 3448, such as [\"ISO VG 10\", \"ISO VG 220\"]";
inline constexpr char what_has_stock[] = "stock is only for \"balancer.ball_diameter\" and \"balancer.oil.grade\"";
inline constexpr char stock_without_units[] = "stock needs a study in physical units";
inline constexpr char must_be_two_ends[] = "stock must have two ends, [low, high]";
inline constexpr char oil_of_one_grade[] = "needs a study without balancer.oil.viscosity_100, which is of one grade";
inline constexpr char too_few_sizes[] =
    "leaves fewer than two stock sizes, which are from {} to {} mm; others go into choices";

// Units. A dimension, an example.
inline constexpr char unit_without_units[] = "has the unit \"{}\"; must be plain numbers: this study has no units";
inline constexpr char must_be_quantity[] = "must be {}, such as \"{}\"";

// Spin-ups. First and last speed; least time.
inline constexpr char must_be_slope[] = "slope must be a speed of rotation a time, such as \"200 rpm/s\"";
inline constexpr char speed_not_prescribed[] =
    "needs a prescribed speed; this rotor is driven by a motor (speed.profile)";
inline constexpr char points_out_of_range[] = "points must be a whole number from 1 to {}";
inline constexpr char lacks_range[] = "lacks range, the speeds of its points";
inline constexpr char until_not_positive[] = "until must be greater than 0";
inline constexpr char slope_not_positive[] = "slope must be greater than 0";
inline constexpr char range_too_narrow[] =
    "range must hold the speeds that the spin-up begins and ends with, {:.6g} and {:.6g}";
inline constexpr char slope_too_small[] = "with this slope the final speed takes {:.6g}, longer than until";

// The proposed [design], in TOML.
inline constexpr char nothing_to_choose[] =
    "missing, and this study states no number, size or drag of equal balls that could be chosen; must be a table that "
    "says what may be varied and what is wanted";
inline constexpr char toml_of_search[] =
    "\n[design]\nobjective = [\"peak_radial.{:.6g}\"]\nstarts = {}\ntrajectories = {}\n";
inline constexpr char toml_of_latin[] = "method = \"latin\"\n";
inline constexpr char toml_of_balanced[] = "balanced = {{ above = {:.6g} }}\n";
inline constexpr char toml_of_limits[] = "limits_kept = {{ above = {:.6g} }}\n";
inline constexpr char toml_of_sizes[] = "{{ stock = [\"{} mm\", \"{} mm\"] }}";
inline constexpr char toml_of_whole_mm[] = "{{ range = [\"{:.0f} mm\", \"{:.0f} mm\"], step = \"1 mm\" }}";
inline constexpr char toml_of_oils[] = "{{ stock = [\"ISO VG {:.0f}\", \"ISO VG {:.0f}\"] }}";
inline constexpr char toml_of_range[] = "{{ range = [{}, {}], scale = \"log\", digits = 2 }}";

}  // namespace equipoise::words::design_study
