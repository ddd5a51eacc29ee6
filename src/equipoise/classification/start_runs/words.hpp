// Sentences and words that more than one file of this chapter, or of those below it, prints.
#pragma once

namespace equipoise::words::proof {

// Why a proof is not tried.
inline constexpr char speed_is_finite[] = "the speed must be a finite number";
inline constexpr char two_planes_of_two[] = "proofs about a rotor that tilts are for two balls in each of two planes";
inline constexpr char plane_with_nothing_to_cancel[] =
    "a plane whose balls have nothing to cancel has a continuum of balanced states; proofs are for isolated ones";

// Number drawn, speed, least and largest growth rate.
inline constexpr char unstable[] = "the balanced state exists but is unstable at speed {} (growth rate {:.3g})";

// What a search for a proof comes to.
inline constexpr char stopped[] = "stopped before it was proved";

// What is wrong with a certificate about an isolated balanced state.
inline constexpr char form_frame_level[] = "form, frame or level do not fit the number of balls";
inline constexpr char other_speed[] = "the speed is not that of balance";
inline constexpr char angles_enclose_none[] = "the ball angles do not enclose a balanced state";
inline constexpr char reaches_around[] = "the level set reaches around the race";
inline constexpr char angles_not_close[] = "the ball angles are not close enough to a balanced state";
inline constexpr char motor_reaches_limit[] = "the motor reaches its limit on the level set";

// What is wrong with a certificate about a member of a continuum.
inline constexpr char no_decrease_in_box[] = "V does not decrease all over the box";

}  // namespace equipoise::words::proof
