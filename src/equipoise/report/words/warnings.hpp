// Warnings about a study that can be computed nevertheless.
#pragma once

namespace equipoise::words::warnings {

// The final speed and the run-up. Of the motor: why; of a long run-up: its time, the speed reached, the time followed.
inline constexpr char speeds_up_without_end[] = "{}; in balance the rotor speeds up without end";
inline constexpr char below_critical_speed[] =
    "the final speed is below the critical speed: there balls gather on the heavy side and add to the unbalance";
inline constexpr char near_critical_speed[] =
    "the final speed is within 10 % of a critical speed: vibration is near its largest";
inline constexpr char little_isolation[] =
    "the final speed is less than sqrt(2) times the critical speed: vibration without balls exceeds twice the "
    "eccentricity unless damping is strong{}";
// Of a rotor that tilts: its highest critical speed, then often_unstable_too or nothing.
inline constexpr char little_isolation_of_tilt[] =
    "the final speed is less than sqrt(2) times the highest critical speed, {}: without balls, whirl of that kind is "
    "more than twice as wide as at high speeds, if the unbalance excites it and damping is not strong{}";
// The highest, then adds_to_whirl or nothing.
inline constexpr char between_critical_speeds[] =
    "the final speed lies between critical speeds, below the highest, {}: whirl of that kind is not yet passed{}";
inline constexpr char adds_to_whirl[] = ", there balls gather on the heavy side, and balance is often unstable";
inline constexpr char often_unstable_too[] = ", and balance is often unstable";
inline constexpr char motor_may_be_too_weak[] = "the motor may be too weak for the critical speed: {}";
inline constexpr char torque_may_not_suffice[] = "the motor's torque may not suffice at the critical speed: {}";
inline constexpr char long_run_up[] =
    "without any losses the motor takes {} to bring the rotor to {}, longer than starts are followed, {}: they may "
    "stay undecided";
// Starts tried, starts held, words for their ends.
inline constexpr char balls_never_let_go[] = "of {} starts tried {} never let their balls go: {}";

// The balls: what they are, weigh, touch and meet.
inline constexpr char weight_beats_rotation[] =
    "at the final speed the weight of a ball exceeds its centrifugal force: it falls off the top of the race";
inline constexpr char restitution_without_contact[] =
    "balancer.restitution has no effect: balls of no contact_angle pass each other";
inline constexpr char balls_heavier_than_rotor[] = "the balls together are heavier than the rotor";
inline constexpr char high_reynolds_number[] =
    "the Reynolds number of a ball that slips is {:.3g}: Stokes' drag holds below about 1, so only near balance, where "
    "balls creep, and is too small before";
inline constexpr char balls_pass_through[] =
    "balls pass through each other in this study, which real balls do not: shares and shaking may differ{}";
inline constexpr char equal_diameters_needed_too[] = "; contact needs balls of one balancer.ball_diameter";
inline constexpr char too_many_balls[] =
    "{} balls of this size do not fit into the race: there is room for {:.0f} % of them";

// Sagging: how far, and what that exceeds.
inline constexpr char at_bearing[] = " at the bearing at {}";
inline constexpr char sags_beyond_race[] =
    "the rotor sags by {} under its weight, more than the race's radius, {}: no suspension is as soft as that";

// The unbalance and what the balls cancel, all balls together or side by side.
inline constexpr char one_ball_cancels_one[] = "one ball cancels {} and no other unbalance; this one is {}";
inline constexpr char balls_together[] = "all balls together";
inline constexpr char balls_side_by_side[] = "all balls side by side";
inline constexpr char unbalance_too_large[] = "the unbalance is {:.3g} times what {} can cancel";
inline constexpr char unbalance_too_small[] =
    "the unbalance is below the least that these balls can balance: they would add one of their own";
inline constexpr char unbalance_near_most[] = "the unbalance is within 10 % of the most that {} can cancel";
inline constexpr char of_plane[] = "plane at {}: ";
inline constexpr char balance_impossible[] = "balance is impossible: {}";
inline constexpr char unbalance_near_least[] = "the unbalance is within 10 % of the least that these balls can balance";

// Balance by linear theory: what was left out, and what would help.
inline constexpr char not_linearly_stable[] =
    "balance is not linearly stable at the final speed{}: its largest rate is within 1e-9 of 0";
inline constexpr char unstable[] =
    "balance is unstable at the final speed{}: the balls do not stay there; {} drag makes it less so";
inline constexpr char settles_slowly[] = "balance settles slowly, in more than 1000 units of time{}{}";
inline constexpr char slower_than_run_up[] = "balance settles more slowly than the rotor spins up{}{}";
inline constexpr char overdamped[] = "the balls are overdamped{}{}";
inline constexpr char more_drag_too[] = "; more drag would bring balance sooner";
inline constexpr char less_drag_too[] = "; less drag would bring balance sooner";
inline constexpr char drag_hardly_matters_too[] = "; the balls' drag hardly changes that";

// Cost. Key, value, steps, steps allowed; why, time followed.
inline constexpr char stiff[] =
    "stiff: with {} = {:.4g} a start takes about {:.1g} steps; basin and attractors refuse above {:.3g}";
inline constexpr char may_stay_undecided[] = "{}: of starts that are followed for {:.6g} many may stay undecided";

}  // namespace equipoise::words::warnings
