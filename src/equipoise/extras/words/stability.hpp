// What is said of where balance is stable in a plane of two parameters.
#pragma once

namespace equipoise::words::stability {

// Input.
inline constexpr char key_of_axis[] =
    "must be a key of rotor, balancer or speed that takes a number, or speed.final; balance does not depend on starts";
inline constexpr char points_range[] = "points; must be a whole number from 1 to {}";
inline constexpr char rising_range[] = "must be two finite numbers, the first below the second";
// Millions.
inline constexpr char too_many_points[] = "points; must be at most {:.1f} million in all (4096x4096)";

// Files.
inline constexpr char file[] = "must be a new file, or one that \"stability -o\" wrote";
inline constexpr char no_such_file[] = "holds no plane of stability; {}";
inline constexpr char these_results[] = "this plane of this study";
inline constexpr char file_title[] = "where balance is stable in a plane of two parameters";

// The answer. Keys in words, balance or one of many balanced states, what it is.
inline constexpr char everywhere[] = "Over {} and {}, {} is {} at every point of the grid.";
inline constexpr char by_parts[] = "Over {} and {}, {} is {}.";
// The last: percent.
inline constexpr char by_parts_of_a_stopped_plane[] =
    "Over {} and {}, {} is {}; {} of the plane was not computed (PARTIAL).";
inline constexpr char balance[] = "balance";
inline constexpr char balance_of_spread_balls[] = "balance with the balls spread evenly, one state of a continuum,";
inline constexpr char nothing_computed[] = "Over {} and {}, nothing was computed (PARTIAL).";
// What it is, percent.
inline constexpr char part[] = "{} in {}";
inline constexpr char is_stable[] = "stable";
inline constexpr char is_unstable[] = "unstable";
inline constexpr char is_none[] = "impossible";
inline constexpr char is_marginal[] = "undecided by linear theory";
inline constexpr char is_unknown[] = "not found";
inline constexpr char not_computed[] = "not computed";

// The study's own point: key and value twice, what holds there.
inline constexpr char own_point[] = "At the study's own values, {} and {}, {}.";
// The time, what the slowest deviation does.
inline constexpr char own_stable[] = "it is stable: the slowest deviation falls to 1/e in {}{}";
// The time, what it does, number.
inline constexpr char own_unstable[] = "it is unstable: a deviation grows by a factor e in {}{} ({} unstable {})";
inline constexpr char own_none[] = "no balanced state exists";
inline constexpr char own_marginal[] = "linear theory does not decide: the slowest deviation hardly changes";
inline constexpr char own_unknown[] = "no balanced motion was found";
// Of a continuum: members drawn, what they are.
inline constexpr char continuum_drawn[] = "Of {} balanced states drawn evenly from the continuum {}.";
// Number.
inline constexpr char continuum_part[] = "{} are stable";
inline constexpr char continuum_unstable[] = "all are unstable";
inline constexpr char continuum_few_stable[] = "all are unstable, though stable ones were found beside them";
// Time each.
inline constexpr char continuum_decay[] = ": their slowest deviations fall to 1/e in {}";
inline constexpr char continuum_growth[] = "; deviations of unstable ones grow by a factor e in {} or more";
// Frequency.
inline constexpr char swings[] = ", swinging at {}";
inline constexpr char own_outside[] = "These values lie outside the plane.";

// The way to the boundary. Smaller or larger, key in words, value.
inline constexpr char with_smaller[] = "smaller";
inline constexpr char with_larger[] = "larger";
inline constexpr char no_change[] = "With a {} {} nothing changes down to the plane's end, {}.";
inline constexpr char no_change_up[] = "With a {} {} nothing changes up to the plane's end, {}.";
// Smaller or larger, key, value, what happens there.
inline constexpr char change_at[] = "With a {} {} this changes at {}: {}.";
// Frequency.
inline constexpr char at_hopf[] = "a pair of eigenvalues crosses (Hopf), at frequency {}";
inline constexpr char at_zero[] = "a real eigenvalue crosses zero";
inline constexpr char at_existence_end[] = "the balanced state ends";
inline constexpr char at_existence_begin[] = "a balanced state begins to exist";
inline constexpr char at_jump[] = "there it jumps, as where a motor comes to hold another speed";
inline constexpr char at_loss[] = "beyond it no balanced motion is found";

// Axes: letter, key, ends, points.
inline constexpr char axis[] = "{}: {} from {} to {} in {} points\n";
inline constexpr char what_balance_is[] = "balance is";
inline constexpr char of_the_plane[] = "of the plane";
inline constexpr char slowest_decay[] = "rates, omega_c";

// Notes. Points or "all points", what is left out.
inline constexpr char left_out_at[] = "At {} {} is left out.\n";
inline constexpr char all_points[] = "all points";
// Number.
inline constexpr char some_points[] = "{} point{}";
inline constexpr char dry_friction[] = "dry friction";
inline constexpr char gravity[] = "gravity";
inline constexpr char unequal_supports[] = "the difference between the supports in x and y";
inline constexpr char motor[] = "what the motor does about deviations of the speed";
inline constexpr char one_of_many[] =
    "The balanced states form a continuum. What is called stable or unstable, and its rates, are those of one of them, "
    "with the balls spread evenly: laid end to end in their order, unbalance and balls are a polygon inscribed in a "
    "circle.\n";
inline constexpr char of_several[] =
    "The balls balance in several states, whose rates differ. What is called stable or unstable, and its rates, are "
    "those of the most stable state at each point; others may be unstable there.\n";
inline constexpr char balls_at_rest[] = "Balls at rest in balance do not touch, so contact plays no part.\n";
inline constexpr char by_multipliers[] =
    "The equations depend on the rotor's angle: rates are those of multipliers, and frequencies are known but for "
    "whole turns.\n";
inline constexpr char partial[] = "PARTIAL: {} of {} points were computed.\n";
inline constexpr char partial_boundaries[] =
    "PARTIAL: stopped before all changes next to the study's own values were found.\n";
inline constexpr char looks[] = "steps to the next change";
// First line of an incomplete table of points: version, that it is partial.
inline constexpr char csv_partial[] = "# equipoise {}: stability{}\n";
// Points, time, rate, version.
inline constexpr char made_with[] = "{} points; {}, {:.0f} points/s; equipoise {}\n";

// Pictures.
inline constexpr char legend[] = "balance {}, {}";
inline constexpr char legend_not_computed[] = "not computed, {}";
inline constexpr char darker_is_faster[] = "The darker, the faster deviations die out or grow.";
inline constexpr char what_balance_does[] = "What balance does over the plane";
inline constexpr char of_spread_balls[] = "; balls spread evenly, one balanced state of many";
inline constexpr char line_hopf[] = "a pair crosses (Hopf)";
inline constexpr char line_zero[] = "a real eigenvalue crosses";
inline constexpr char line_existence[] = "balance ends";
inline constexpr char the_study[] = "the study";

}  // namespace equipoise::words::stability
