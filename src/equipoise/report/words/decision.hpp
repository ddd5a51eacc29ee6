// Whether to fit the balancer and why, what to change, and what standards say of it.
#pragma once

#include <array>
#include <utility>

namespace equipoise::words::decision {

// Verdicts where the study has limits. {}: the share that must keep them.
inline constexpr char not_needed[] = "Not needed: the rotor keeps every limit without a balancer too.";
inline constexpr char not_needed_whatever_balls_do[] = "Not needed: without balls the rotor keeps every limit.";
// {}: what grows.
inline constexpr char fit_if_it_may_shake[] = "Fit it only if more vibration on the way is acceptable: {}.";
inline constexpr char fit[] = "Fit it: at least {} of starts keep every limit.";
// {}: what grows.
inline constexpr char on_the_way[] = " On the way {}.";
inline constexpr char do_not_fit[] = "Do not fit it: without balls the rotor keeps every limit.";
inline constexpr char do_not_fit_as_it_is[] =
    "Do not fit it as it is: too few starts keep the limits ({} are asked), and half of them end shaking more than "
    "without balls.";
inline constexpr char change_it[] = "Change it: too few starts keep every limit; {} are asked.";
inline constexpr char not_decided[] = "Not decided yet: whether {} of starts keep every limit.";

// Below the critical speed, whatever the limits are. Why.
inline constexpr char do_not_fit_because[] = "Do not fit it: {}.";

// Verdicts where it has none: vibration at the end is compared.
inline constexpr char fit_half_the_vibration[] = "Fit it: in 90 % of starts it ends with at most half the vibration.";
inline constexpr char do_not_fit_more_vibration[] =
    "Do not fit it as it is: half of the starts end shaking more than without balls.";
inline constexpr char change_too_much_vibration[] =
    "Change it: too many starts end with more than half of the vibration without balls.";
inline constexpr char not_decided_vibration[] =
    "Not decided yet: whether 90 % of starts end with at most half the vibration.";

// Reasons. Shares.
inline constexpr char share_keeps_limits[] = "{} of starts keep every limit";
inline constexpr char share_on_the_way_and_at_end[] = ", {} on the way and {} at the end";
inline constexpr char share_without_balls[] = "; without balls {}";
inline constexpr char rotor_alone_too[] = "; the rotor without balls keeps them all";
inline constexpr char rotor_alone_not[] = "; the rotor without balls does not";
// Most in 90 % of starts, unit, interval or nothing, value without balls.
inline constexpr char velocity_at_end[] =
    "RMS velocity at the end in 90 % of starts at most {} {}{}; without balls {}{}.";
// Times.
inline constexpr char times_its_own_rotor[] =
    ". In 90 % of starts it is at most {} times that of the same rotor without balls";
inline constexpr char interval[] = " ({} to {})";
inline constexpr char peak_and_without_balls[] =
    "the peak reaches {:.3g} {} in one start of ten, {:.3g} {} without balls";
// Where no start was followed.
inline constexpr char by_linear_theory[] = "By linear theory; no start has to be followed for that.";

// What to change.
inline constexpr char nothing_to_change[] = "Nothing has to change.";
inline constexpr char leave_it_out[] = "Leave the balancer out.";
inline constexpr char search_for_better[] = "\"equipoise design\" searches for a better balancer.";
inline constexpr char longer_horizon[] = "{} of starts are undecided: a longer numerics.horizon may tell.";
// Where the motor does not bring the rotor up to speed without balls either.
inline constexpr char more_torque[] =
    "{} of starts are undecided, and the rotor stalls even without balls: give its motor more torque.";
inline constexpr char more_starts[] = "Run more starts: --starts {}.";

// The best of the changes tried: a figure of it, and how it serves.
inline constexpr char starts_keep_limits[] = "{} of {} starts keep every limit";
inline constexpr char velocity_in_most_starts[] = "at the end at most {:.3g} {} in 90 % of {} starts";
inline constexpr char peak_in_few_starts[] = "the peak reaches {:.3g} {} in one start of ten";
// Change, figure, nothing or its peak.
inline constexpr char with_change[] = "With {}: {}{}.";
inline constexpr char with_change_lower_peak[] = "With {}: {} ({} starts).";
inline constexpr char no_change_lowers_peak[] =
    "None of {} changes tried is shown to lower the peak. \"equipoise design\" searches further.";
inline constexpr char no_change_keeps_limits[] =
    "With none of {} changes tried does a start keep every limit. \"equipoise design\" searches further.";
inline constexpr char no_change_is_enough[] =
    "None of {} changes tried is enough; best is {}: {}. \"equipoise design\" searches further.";

// Motions (attractors/motions/motion_name.cpp), by how their names begin; longer beginnings first.
inline constexpr std::array<std::pair<const char*, const char*>, 11> plain_words{{
    {"co-drifting", "balls circulate together"},
    {"drifting apart", "balls circulate apart"},
    {"drifting at different rates", "balls circulate at different rates"},
    {"drifting", "ball circulates"},
    {"pair drift", "balls circulate as a pair"},
    {"one captured", "one ball stays, one circulates"},
    {"both captured", "balls stay, off balance"},
    {"all captured", "balls stay, off balance"},
    {"captured", "ball stays, off balance"},
    {"locked", "balls stay, off balance"},
    {"hanging", "balls stay below the shaft"},
}};

// The table of changes. Caption: "Of " or nothing, changes, how many starts each had, how to read the figures.
inline constexpr char as_it_is[] = "as it is";
inline constexpr char keep_limits[] = "keep every limit";
inline constexpr char velocity_column[] = "RMS velocity at the end, {}";
inline constexpr char peak_column[] = "peak displacement, {}";
inline constexpr char changes_tried[] = "{}{} changes tried, {}, best first. {}.";
inline constexpr char each_on[] = "each on {} starts";
inline constexpr char on_fewer_starts[] = "each on {} starts, or on {} where that was enough to see it fail";
inline constexpr char of[] = "Of ";
inline constexpr char shares_and_peak[] = "Shares with their 95 % intervals; peak: 90 % of starts below";
inline constexpr char velocity_and_peak[] = "Velocity and peak: 90 % of starts below";

// Changes that an engineer would make first.
inline constexpr char twice_the_drag[] = "twice the drag";
inline constexpr char half_the_drag[] = "half the drag";
inline constexpr char balls[] = "{} balls";
inline constexpr char larger_balls[] = "larger balls, a quarter more in diameter";
inline constexpr char smaller_balls[] = "smaller balls, a fifth less in diameter";
inline constexpr char balls_of[] = "balls of {:.0f} mm";
inline constexpr char latch_until[] = "a latch that holds the balls until {}";
inline constexpr char half_the_run_up[] = "a run-up of half the time";

// Hand-arm vibration.
inline constexpr char over_a_day[] = "over 24 h";
inline constexpr char minutes[] = "{:.2g} min";
inline constexpr char hand_arm_vibration[] = "hand-arm vibration";
inline constexpr char ninety_below[] = "90 % below";
inline constexpr char no_balls[] = "no balls";
inline constexpr char action_value[] = "action value";
inline constexpr char limit_value[] = "limit value";
// A(8), "action value" or "limit value".
inline constexpr char work_until[] = "work until A(8) is {} m/s2, the {}";
// As what handles move.
inline constexpr char hand_arm_caption[] =
    "a_hv by ISO 5349-1, a day's exposure A(8) and its values by 2002/44/EC. An estimate, not a declared value: the "
    "handles move as {}, at the speed of rotation only.";
inline constexpr char centre_of_race[] = "the race's centre";
inline constexpr char faster_bearing[] = "the outermost bearing that moves faster";
inline constexpr char centre_of_mass[] = "the shaft at the centre of mass";
inline constexpr char hand_arm_source[] = "ISO 5349-1:2001, Directive 2002/44/EC";

// Severity of vibration. Caption: zone, class, its machines, which directions.
inline constexpr char too_slow_for_zones[] =
    "Severity: at {:.3g} turns a second no zone is given; the band of ISO 10816-1 begins at {} Hz.";
inline constexpr char severity[] = "Severity: ";
inline constexpr char severity_zone[] = "severity zone";
inline constexpr char share_ends_there[] = "ends there";
inline constexpr char velocity[] = "RMS velocity";
inline constexpr char zone_a[] = "A, as new";
inline constexpr char zones_a_and_b[] = "A or B, for long operation";
inline constexpr char zones_a_to_c[] = "A to C; D may damage";
inline constexpr char up_to[] = "to {} mm/s";
inline constexpr char severity_caption[] =
    "Without balls: zone {}. Zones of ISO 10816-1:1995, class {} ({}), of {}. ISO 20816-1:2016 took its place; ISO "
    "20816-3 begins at 15 kW.";
inline constexpr char one_direction[] = "one direction";
inline constexpr char larger_direction[] = "the direction that has more";

// Sliding and balance quality. A machine's mass, friction, force it takes, share of starts or nothing, peak force
// without balls.
inline constexpr char may_slide[] =
    "A machine of {:.4g} kg on feet with friction {} may slide when {:.4g} N act on the supports{}; without balls the "
    "peak is {:.4g} N{}. It may turn on its feet at a smaller force [PP].";
inline constexpr char slides_in[] = ": so it is in {} of starts";
inline constexpr char enough[] = ", enough for that";
inline constexpr char enough_too[] = ", enough too";
inline constexpr char balance_quality[] =
    "Balance quality e omega [ISO 21940-11]: {} left on average; without balls {}.";
// Grade in mm/s, speed, unbalance, unbalance.
inline constexpr char permissible_unbalance[] = " G {:.3g} at {} permits {}; {} is left.";
inline constexpr char balance_quality_alone[] = "Balance quality e omega [ISO 21940-11]: {}.";

}  // namespace equipoise::words::decision
