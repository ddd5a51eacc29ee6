// What was understood of a study: machine, unbalance, balls, assumptions, and what matters most.
#pragma once

namespace equipoise::words::study_check {

// The lines, and what stands in them.
inline constexpr char lines[] = "Machine: {}.\nUnbalance: {}.\nBalls: {}.\nAssumed: {}.\nMatters most: {}.\n";
// Mass or "supports of", then the stiffness.
inline constexpr char mass_on[] = "{} on ";
inline constexpr char supports_of[] = "supports of ";
inline constexpr char with_critical_speed[] = ", critical speed {}";
// After critical speeds, unless there are no balls.
inline constexpr char with_its_balls[] = " with its balls";
inline constexpr char runs_at[] = "; runs at {}, {:.3g} times {}";
inline constexpr char that[] = "that";
inline constexpr char the_higher[] = "the higher";
// The speed where the motor's torque vanishes, that where unbalance takes all of it.
inline constexpr char may_stall[] =
    "; made to run at {}, but may stall at {}, where its own unbalance takes all that the motor gives";
inline constexpr char tilting_with_critical_speeds[] = ", tilting, critical speeds {}";
inline constexpr char runs_at_highest[] = "; runs at {}, {:.3g} times the highest";
inline constexpr char no_speed_held[] = "; no speed is held in the end";
inline constexpr char centre_of_mass[] = ", its centre of mass {} from the shaft";
inline constexpr char static_and_couple[] = "{} static and {} couple";
inline constexpr char with_the_race[] =
    "; the off-centre race makes it {} at the final speed, which the balls have to cancel";
inline constexpr char no_couple[] = "; x of the model points at 0 degrees";
inline constexpr char couple_direction[] = "; x of the model points along the couple, at {:.3g} degrees";
inline constexpr char grade_at_speed[] = "; {} at {}";
inline constexpr char grade_in_planes[] = "; {} in the worse plane of its bearings at {}";
// "the rotor's own and of " or nothing, number of places, "s" or nothing, degrees.
inline constexpr char resultant_of_places[] =
    "; the resultant of {}{} place{}, at {:.3g} degrees, where x of the model points";
inline constexpr char of_the_rotor_too[] = "the rotor's own and of ";
inline constexpr char no_balls[] = "none: nothing cancels the unbalance";
inline constexpr char on_a_circle[] = " on a circle of {}";
inline constexpr char nothing_to_cancel[] = "; they cancel {}, and there is nothing to cancel";
// Range, "up to" or "at most", a factor, nothing or that balance is impossible.
inline constexpr char balls_cancel[] = "; they cancel {}, {} {:.3g} times what there is{}";
// Of a plane: its place, "no less than", "up to" or "at most", a factor.
inline constexpr char plane_cancels[] = "; at {} they cancel {} {:.3g} times what there is";
inline constexpr char no_less_than[] = "no less than";
inline constexpr char balance_impossible_as[] = ": balance is impossible ({})";
inline constexpr char nothing_to_cancel_at[] = "; at {} there is nothing to cancel";
inline constexpr char up_to[] = "up to";
inline constexpr char at_most[] = "at most";
inline constexpr char balance_impossible_too[] = ": balance is impossible";
inline constexpr char balance_unstable[] = ", but balance is not stable at the final speed";

// What matters most: what is changed by a fifth.
inline constexpr char the_unbalance[] = "the unbalance";
inline constexpr char the_stiffness[] = "the stiffness of the supports";
inline constexpr char the_damping[] = "the damping of the supports";
inline constexpr char the_drag[] = "the drag of the balls";
inline constexpr char of_a_formula[] = ", here from a formula";
inline constexpr char the_ball_mass[] = "the mass of the balls";

// What such a change does.
inline constexpr char the_oil_temperature[] = "the temperature of the oil";
// What, how that is known, how much of it, "less" or "more", the effect.
inline constexpr char change_does[] = "{}{}: {} {} of it {}";
inline constexpr char a_fifth[] = "20 %";
inline constexpr char ten_kelvin[] = "10 K";
inline constexpr char makes_balance_possible[] = "makes balance possible";
inline constexpr char makes_balance_impossible[] = "makes balance impossible";
inline constexpr char makes_balance_stable[] = "makes balance stable";
inline constexpr char makes_balance_unstable[] = "makes balance unstable";
inline constexpr char drag_too_little_to_pass[] =
    "leaves the balls so little drag that they may stay at the critical speed";
inline constexpr char drag_enough_to_pass[] = "gives the balls the drag that takes them past the critical speed";
inline constexpr char leaves_balls_hanging[] = "leaves balls hanging below the shaft";
inline constexpr char carries_balls_round[] = "gives the balls the drag that carries them round";
inline constexpr char changes_capacity[] = "lets the balls cancel {:.3g} instead of {:.3g} times what there is";
inline constexpr char changes_settling[] =
    "lets a deviation from balance fade with a time constant of {} instead of {}";
inline constexpr char stays_impossible[] =
    "none of these: with each of them changed alone by 20 % balance stays impossible";
inline constexpr char stays_unstable[] =
    "none of these: with each of them changed alone by 20 % balance stays unstable";
inline constexpr char nothing_matters[] = "none of these, by these rules";
inline constexpr char nothing_without_balls[] = "not judged: there are no balls";
// What is said of the oil, or nothing; what else it is judged by.
inline constexpr char how_judged[] =
    " (of unbalance, supports, damping, drag and ball mass, each changed alone by 20 %{}; judged by what the balls can "
    "cancel{}, not by trajectories)";
inline constexpr char and_of_the_oil[] = ", and of 10 K in the oil if they make or break balance";
inline constexpr char and_by_plane_rules[] = ", linear theory at the final speed and the drag against capture";
inline constexpr char and_by_plane_rules_and_weight[] =
    ", linear theory at the final speed, the drag against capture and that against the balls' weight";
inline constexpr char and_by_tilt_rules[] = " in each plane and linear theory at the final speed";
inline constexpr char and_by_tilt_rules_and_weight[] =
    " in each plane, linear theory at the final speed and the drag against the balls' weight";

inline constexpr char stopped[] = "not known: it was stopped";

// What is assumed because the study does not say it.
inline constexpr char balls_free_from_start[] = "balls free from t = 0";
inline constexpr char balls_held_in_run_up[] = "balls held until the run-up is over";
inline constexpr char small_slopes[] = "small slopes, balls that stay in their planes";
inline constexpr char balls_touch[] = "balls touch";
inline constexpr char balls_pass_through[] = "balls pass through each other";
inline constexpr char restitution[] = "restitution {:.3g}";
inline constexpr char balls_roll[] = "balls roll without sliding";
inline constexpr char balls_slide[] = "balls are points that slide";
inline constexpr char no_rolling_resistance[] = "no rolling resistance";
inline constexpr char race_centred[] = "race centred on the shaft";
inline constexpr char typical_density[] = "typical density of {}";
inline constexpr char silicone_oil[] = "oil of {}, by the law of silicone oils";
inline constexpr char oil_of_middle[] = "oil of {}, in the middle of its class";
inline constexpr char oil_of_middle_and_index[] = "oil of {}, in the middle of its class, viscosity index 95";
inline constexpr char drag_in_a_tube[] = "drag of a ball on the axis of a tube";
inline constexpr char drag_of_stokes[] = "Stokes drag, without walls";
inline constexpr char supports_alike[] = "supports alike in x and y";
inline constexpr char viscous_damping[] = "viscous damping";
inline constexpr char no_gravity[] = "no gravity across the shaft";
inline constexpr char values_at_medians[] = "uncertain values at their medians";
inline constexpr char angles_without_direction[] = ", angles that are drawn all round at a quarter turn";

}  // namespace equipoise::words::study_check
