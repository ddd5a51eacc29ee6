// Balance, what a system lacks for a result, and values out of their ranges.
// This room: the sentences of this chapter.
#pragma once

namespace equipoise::words::mechanics {

// Why there is no balanced state.
inline constexpr char gravity_moves_balls[] = "gravity keeps the balls moving in the rotating frame";
inline constexpr char unbalance_too_large[] = "the unbalance is larger than all balls together can cancel";
inline constexpr char one_ball_outweighs[] = "one ball outweighs the unbalance and the other balls together";
inline constexpr char lone_ball[] = "one ball alone cancels its own unbalance, neither more nor less";
inline constexpr char one_plane_leaves_couple[] =
    "the balls run in one plane, and not all of the unbalance lies in it: a couple stays";
inline constexpr char no_angles_cancel_both[] =
    "no angles of the balls were found that cancel the static and the couple unbalance together";
// Before one of the reasons above.
inline constexpr char plane_cannot_cancel[] = "of the share of one plane, ";
inline constexpr char comes_to_rest[] = "the rotor comes to rest: nothing balances it";
inline constexpr char race_off_centre[] =
    "with the race off centre the supports' damping slows a coasting rotor: no speed is held";
// Vibration can absorb a torque that never vanishes; a balanced rotor cannot.
inline constexpr char no_speed_is_held[] =
    "a balanced rotor needs no torque, and the motor's never vanishes: balanced, it would speed up without end";
// Follows "the" or "the motor's".
inline constexpr char holds_no_speed[] = "last torque never ends, and a balanced rotor needs none: no speed is held";

// Balls in contact: why they cannot cancel the unbalance.
inline constexpr char balls_do_not_fit[] = "the balls do not fit into the race";
inline constexpr char no_order_found[] =
    "of many orders of these balls in the race, none that was tried cancels just the unbalance";
inline constexpr char cancel_less_side_by_side[] = "balls of this size, side by side, cancel less than the unbalance";
inline constexpr char no_room_to_cancel_little[] =
    "balls of this size have no room to cancel as little as the unbalance";
inline constexpr char no_order_cancels[] = "no order of these balls in the race cancels just the unbalance";

// What a result needs of a system.
inline constexpr char prescribed_speed[] = "a prescribed speed";
inline constexpr char passing_balls[] = "balls that pass each other, 0 or contact = false";
inline constexpr char sliding_balls[] = "balls without rolling resistance or stiction, 0";
inline constexpr char centred_race[] = "a centred race, [0, 0]";
inline constexpr char equal_supports[] = "equal values in x and y";
inline constexpr char no_gravity[] = "gravity 0";
inline constexpr char no_tilt[] = "a rotor that does not tilt, without rotor.tilt";
inline constexpr char turning[] =
    "a rotor that turns in the end (other than 0) where supports are unequal or gravity acts";
inline constexpr char linear_torque[] = "a motor whose torque is linear in the speed, without a load";
inline constexpr char lasting_drive[] = "a drive that lasts";

// Values that cannot be read.
inline constexpr char speed_never_reached[] = "the ramp function never reaches it; must be from {} to {}";

}  // namespace equipoise::words::mechanics
