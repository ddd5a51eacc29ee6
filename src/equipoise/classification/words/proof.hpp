// What is known of balanced states: proofs about them, and why there is none, or an unstable one.
// This room: the sentences of this chapter.
#pragma once

namespace equipoise::words::proof {

// Why a proof is not tried.
inline constexpr char continuum_of_many[] =
    "three balls or more have a continuum of balanced states; proofs are for isolated ones";
inline constexpr char continuum_without_unbalance[] =
    "without unbalance there is a continuum of balanced states; proofs are for isolated ones";
inline constexpr char needs_three_balls[] = "proofs about a continuum are for three balls or more";
inline constexpr char needs_equal_supports[] = "proofs need supports that are equal in x and y";
inline constexpr char needs_no_gravity[] = "proofs need gravity 0";
inline constexpr char needs_centred_race[] = "proofs about a continuum need a centred race";
inline constexpr char needs_passing_balls[] = "proofs need balls that pass each other and do not stick";
inline constexpr char speed_is_finite[] = "the speed must be a finite number";
inline constexpr char two_planes_of_two[] = "proofs about a rotor that tilts are for two balls in each of two planes";
inline constexpr char plane_with_nothing_to_cancel[] =
    "a plane whose balls have nothing to cancel has a continuum of balanced states; proofs are for isolated ones";
inline constexpr char for_one_or_two[] = "proofs are for one or two balls";
inline constexpr char for_plain_continuum[] =
    "the balanced states form a continuum; proofs about one are for three balls or more, at a prescribed speed, in a "
    "centred race";

// Balanced states: none, unstable, or lost.

// Why.
inline constexpr char no_balanced_state[] = "no balanced state exists: {}";
// Number drawn, speed, least and largest growth rate.
inline constexpr char all_drawn_unstable[] =
    "the balanced states form a continuum, and all {} drawn evenly from it are unstable at speed {} (growth rates "
    "{:.3g} to {:.3g})";
inline constexpr char none_drawn_attracts[] = "no member of the continuum that was drawn attracts at speed {}";
inline constexpr char unstable[] = "the balanced state exists but is unstable at speed {} (growth rate {:.3g})";
inline constexpr char not_linearly_stable[] =
    "the balanced state exists but is not linearly stable at speed {} (largest rate 0)";
// What (one of the three below), how much of it in percent, "it" or "both".
inline constexpr char motion_lost[] =
    "no balanced motion was found: the motion that grows out of the balanced state as {} switched on can be followed "
    "to {:.2g} % of {}";
inline constexpr char gravity_and_supports[] = "gravity and the supports' difference are";
inline constexpr char gravity_is[] = "gravity is";
inline constexpr char supports_are[] = "the supports' difference is";

// What a search for a proof comes to.
inline constexpr char stopped[] = "stopped before it was proved";
inline constexpr char boxes_used_up[] = "the boxes allowed do not suffice to prove level {:.6g}";
inline constexpr char no_decrease_shown[] = "V could not be shown to decrease everywhere below level {:.6g}";
inline constexpr char nothing_proved[] = "neither attraction nor instability could be proved";

// What is wrong with a form or a level, seen before any box is tried.
inline constexpr char form_size[] = "the form must be a {0} x {0} matrix of finite numbers";
inline constexpr char level_is_positive[] = "the level must be a finite number greater than 0";
inline constexpr char form_not_definite[] = "the form is not positive definite";
inline constexpr char state_not_stable[] = "the balanced state is not linearly stable at speed {} (growth rate {:.3g})";
inline constexpr char no_linear_decrease[] = "V does not decrease along the linearised equations";

// What is wrong with a certificate about an isolated balanced state.
inline constexpr char boxes_do_not_cover[] = "the boxes do not cover the level set, each part of it once";
inline constexpr char box_does_not_prove[] = "the box at tau = ({:.4g}, {:.4g}) does not prove that V decreases";
inline constexpr char form_frame_level[] = "form, frame or level do not fit the number of balls";
inline constexpr char motor_at_limit[] = "the motor is at its limit in balance";
inline constexpr char other_speed[] = "the speed is not that of balance";
inline constexpr char one_ball_balances[] =
    "one ball balances only if it weighs as much as the unbalance and the race is centred";
inline constexpr char angle_encloses_none[] = "the ball angle does not enclose a balanced state";
inline constexpr char angles_enclose_none[] = "the ball angles do not enclose a balanced state";
inline constexpr char form_not_symmetric[] = "the form is not symmetric";
inline constexpr char frame_is_not_of_the_form[] = "the frame does not make the level set of the form the unit ball";
inline constexpr char frame_mixes_angles[] = "the frame lets ball angles depend on more than tau";
inline constexpr char reaches_around[] = "the level set reaches around the race";
inline constexpr char angles_not_close[] = "the ball angles are not close enough to a balanced state";
inline constexpr char motor_reaches_limit[] = "the motor reaches its limit on the level set";
inline constexpr char not_the_right_order[] =
    "the equations are not linear in x, y, u, v and quadratic in each ball's speed";

// What is wrong with a certificate about a member of a continuum.
inline constexpr char member_form_size[] = "the form does not fit the number of balls";
inline constexpr char radius_range[] = "the radius must be greater than 0 and less than 1";
inline constexpr char not_definite[] = "V is not positive definite";
inline constexpr char level_not_allowed[] = "the level is not what rate and radius allow";
inline constexpr char no_decrease_in_box[] = "V does not decrease all over the box";
inline constexpr char no_escape[] = "V is not negative in the direction of escape";
inline constexpr char no_state_in_box[] = "no balanced state was found in the box";

// Progress.
inline constexpr char states_tried[] = "states tried on level sets";

}  // namespace equipoise::words::proof
