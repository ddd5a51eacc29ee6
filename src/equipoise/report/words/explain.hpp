// What rules of thumb and linear theory say of a study, and why they say nothing.
#pragma once

namespace equipoise::words::explain {

// Studies to begin with. A guess or nothing, the list of machines.
inline constexpr char one_of_machines[] = "{}must be one of: {}";

// Rules of thumb: why one says nothing.
inline constexpr char below_resonance[] =
    "at or below the critical speed balls gather on the heavy side, whatever their drag";
inline constexpr char no_balanced_state_found[] = "no balanced state was found";
inline constexpr char size_not_given[] = "the study does not give the balls' size";

// What was left out of the rotor.
inline constexpr char without_gravity_too[] = "; without gravity";
inline constexpr char with_means_too[] = "; with the mean of x and y";
inline constexpr char with_a_centred_race_too[] = "; with a centred race";

// Ball mass.
inline constexpr char ball_mass[] = "ball mass";
inline constexpr char ball_mass_formula[] = "lambda <= mu sin(n delta/2)/sin(delta/2), of points n mu";
inline constexpr char ball_mass_source[] =
    "docs/explanation/rules-of-thumb.md, Ball mass; Existence in docs/explanation/equations.md";
inline constexpr char balls_can_cancel[] = "the balls can cancel the unbalance";
inline constexpr char most_cancelled[] = "most that they cancel side by side";
inline constexpr char least_cancelled[] = "least that they cancel";
inline constexpr char fastest_settling_mass[] = "mass of each ball that settles fastest, lambda/sqrt(2)";

// Critical speeds. Vibration: direction, as ", x".
inline constexpr char critical_speed[] = "critical speed";
inline constexpr char critical_speed_formula[] = "Omega >= sqrt(2) sqrt(kappa/(1 + N))";
inline constexpr char critical_speed_source[] =
    "docs/explanation/rules-of-thumb.md, Critical speeds; Clamped balls in docs/explanation/equations.md";
inline constexpr char critical_speed_with_balls[] = "critical speed with the balls";
inline constexpr char largest_vibration[] = "largest vibration";
inline constexpr char of_held_balls[] = ", of held balls";
inline constexpr char resonance_by_weight[] = "balls shake twice a turn by their weight, resonance at";
inline constexpr char run_above[] = "run above";
inline constexpr char far_above_resonance[] = "far enough above resonance";
inline constexpr char near_resonance[] = "near or below resonance";
inline constexpr char between_critical_speeds[] =
    "between the critical speeds of x and y, where balls have no side to gather on";

// Room in the race.
inline constexpr char room[] = "room in the race";
inline constexpr char room_formula[] = "sum of 2 asin(d_i/(2 R)) <= 2 pi";
inline constexpr char room_source[] =
    "docs/explanation/rules-of-thumb.md, Room in the race; Contact in docs/explanation/equations.md";
inline constexpr char balls_fit[] = "the balls fit into the race";
inline constexpr char angle_of_touching_balls[] = "angle between touching balls, 2 asin(d/(2 R))";
inline constexpr char balls_that_fit[] = "balls of this size that fit";
inline constexpr char part_of_race_filled[] = "part of the race that they fill";
inline constexpr char angle_in_balance[] = "angle between them in balance";
inline constexpr char balls_would_overlap[] = "in balance the balls would overlap";

// Drag.
inline constexpr char ball_drag[] = "ball drag";
inline constexpr char drag_formula[] =
    "beta_s/2 <= beta <= 2 beta_s, beta_s = 2 sqrt(s k_b); beta >= N omega^3/(zeta (Omega - omega))";
inline constexpr char drag_source[] =
    "docs/explanation/rules-of-thumb.md, Ball drag; Linearisation in docs/explanation/equations.md";
inline constexpr char all_balls_on_a_line[] =
    "nothing brings the balls of this balanced state back: all lie on one line";
inline constexpr char no_return_between_critical_speeds[] = "between the critical speeds nothing brings the balls back";
inline constexpr char from_by_linear_theory[] = "from (linear theory)";
inline constexpr char fastest_by_linear_theory[] = "fastest (linear theory)";
inline constexpr char to_by_linear_theory[] = "to (linear theory)";
inline constexpr char no_drag_stabilises[] = "by linear theory no drag makes balance stable";
inline constexpr char too_little_drag[] =
    "too little: balance settles at less than a quarter of its fastest rate, or is unstable";
inline constexpr char too_much_drag[] =
    "too much: the balls creep into balance at less than a quarter of the fastest rate";
inline constexpr char drag_settles_fast[] = "balance settles at a quarter of its fastest rate or more";
inline constexpr char with_which_unstable[] = ", with which it is unstable";
inline constexpr char drag_against_lagging[] = "below it balls may lag at the critical speed";
inline constexpr char may_lag_too[] = "; on the way up they may lag behind at the critical speed";

// Gravity across the shaft.
inline constexpr char carried[] = "balls carried round";
inline constexpr char carried_formula[] =
    "beta Omega >= G; of n that touch: n beta Omega >= G sin(n delta/2)/sin(delta/2)";
inline constexpr char carried_source[] = "docs/explanation/rules-of-thumb.md, Carried round";
inline constexpr char carried_from_rest[] = "drag carries balls round against their weight, from rest also";
inline constexpr char not_carried_but_turning[] =
    "drag is too little to carry balls round from rest, but they are let go so fast that none falls";
inline constexpr char not_carried[] =
    "balls that hang below the shaft stay there: drag is too little against their weight";
inline constexpr char carries_all_from[] = "carries all from";
inline constexpr char least_drag_of_one[] = "least at the final speed, of balls that do not touch";

// Settling. The rule knows less than linear theory: what it leaves out follows.
inline constexpr char settling[] = "settling near balance";
inline constexpr char settling_formula[] =
    "slower decay of s q'' + beta q' + k_b q = 0 and (1 + N) r'' + zeta r' + kappa r = 0";
inline constexpr char settling_source[] =
    "docs/explanation/rules-of-thumb.md, Settling; Linearisation in docs/explanation/equations.md";
inline constexpr char falls_to_a_part[] = "a deviation falls to 1/e";
inline constexpr char the_rule[] = "; the rule ";
inline constexpr char nothing_settles[] = "without drag or without damping nothing settles";
inline constexpr char nothing_returns[] = "nothing brings the balls back";
inline constexpr char friction_holds_too[] = "; friction stops the balls short of it";
inline constexpr char by_the_rule[] = "by the rule";
inline constexpr char by_linear_theory[] = "by linear theory";
inline constexpr char unstable_by_linear_theory[] = "; linear theory: not at all, balance is unstable";
inline constexpr char undecided_by_linear_theory[] = "; linear theory: the largest rate is within 1e-9 of 0";

// Torque of the motor.
inline constexpr char motor_torque[] = "motor torque";
inline constexpr char torque_formula[] = "tau(omega) >= (lambda + N)^2 omega^3/zeta, half of it where x and y differ";
inline constexpr char torque_source[] = "docs/explanation/rules-of-thumb.md, Torque; [Som], [Kon]";
inline constexpr char final_speed_below[] = "the final speed is below the critical speed";
inline constexpr char above_from_the_beginning[] = "the rotor is above the critical speed from the beginning";
inline constexpr char no_torque_without_damping[] =
    "without damping no torque holds against resonance: only a fast run-up passes";
inline constexpr char taken_with_balls[] = "taken at resonance with all balls on the heavy side";
inline constexpr char taken_by_rotor[] = "taken at resonance by the rotor's own unbalance";
inline constexpr char speed_is_prescribed[] =
    "the study prescribes the speed; a motor would need as much, besides what speeds the rotor up";
inline constexpr char integral_without_limit[] = "the motor's integral part has no limit";
inline constexpr char largest_torque[] = "largest torque of the motor";
inline constexpr char given_at_critical_speed[] = "given by the motor at the critical speed";
inline constexpr char left_at_critical_speed[] = "left by motor and load at the critical speed";
inline constexpr char enough_while_it_lasts[] = "enough while it lasts, wherever the balls are";
inline constexpr char enough_however_slowly[] = "enough however slowly it passes, wherever the balls are";
inline constexpr char torque_too_short[] = "too little or too short: the rotor's own unbalance stops it";
inline constexpr char torque_too_little[] =
    "less than the rotor's own unbalance takes: without balls it stalls unless it comes with momentum";
inline constexpr char torque_depends_on_balls[] = "whether it is enough depends on where the balls are";

// Linear theory: what was left out, and why it says nothing.
inline constexpr char without_dry_friction[] = "without dry friction";
inline constexpr char without_gravity[] = "without gravity";
inline constexpr char with_means[] = "with the mean of x and y";
inline constexpr char no_balls[] = "there are no balls";
inline constexpr char stopped[] = "it was stopped before it was known";
inline constexpr char no_turning[] = "the rotor does not turn";
inline constexpr char no_balanced_state[] = "there is no balanced state";
inline constexpr char none_in_continuum[] = "no balanced state of the continuum that was tried leaves the balls room";
// What disturbs it follows.
inline constexpr char no_balanced_motion_with[] = "no balanced motion was found with ";
inline constexpr char unequal_supports[] = "unequal supports";

// The final speed of a motor.
inline constexpr char coasting[] =
    "which the rotor has when its motor lets go if nothing has braked it; then nothing holds it";
inline constexpr char where_torque_is_load[] =
    "where the motor gives what the load takes: a balanced rotor needs no more";
inline constexpr char where_torque_is_load_and_dampers[] =
    "where the motor gives what load and supports' dampers take in balance";
inline constexpr char where_torque_vanishes[] = "where the motor's torque vanishes: a balanced rotor needs none";
inline constexpr char where_torque_is_dampers[] = "where the motor gives what the supports' dampers take in balance";

}  // namespace equipoise::words::explain
