// A machine that cannot be: rotor, places of unbalance, balls, oil, motor and speed.
#pragma once

namespace equipoise::words::machine {

// Rotor. What it must be, of keys of which one is needed.
inline constexpr char stiffness[] = "a stiffness greater than 0, such as \"48 kN/m\"";
inline constexpr char natural_frequency[] = "of the rotor without balls, such as \"8 Hz\" or \"480 rpm\"";
inline constexpr char static_sag[] = "under its own weight, such as \"3 mm\"";
inline constexpr char damping[] = "a damping coefficient of 0 or more, such as \"200 N s/m\"";
inline constexpr char ratio_is_percentage[] = "must be at most 1, or a percentage; did you mean \"{:.6g} %\"?";
inline constexpr char logarithmic_decrement[] = "a plain number, per cycle of free vibration, such as 0.3";
inline constexpr char quality_factor[] = "a plain number, sqrt(k M)/c, such as 8";
inline constexpr char loss_factor[] = "a plain number, c/sqrt(k M), such as 0.1";
inline constexpr char eccentricity[] = "a length of 0 or more, such as \"0.2 mm\"";
inline constexpr char unbalance[] = "mass times eccentricity, such as \"300 g mm\"";
inline constexpr char balance_grade[] = "a table such as { grade = \"G 6.3\", at = \"3000 rpm\" }";
inline constexpr char inertia[] = "a moment of inertia greater than 0, such as \"0.02 kg m2\"";

// Rotor: what is wrong.
inline constexpr char must_be_grade[] =
    "must be a balance quality grade such as \"G 6.3\", or what it means, \"6.3 mm/s\"";
inline constexpr char grade[] = "a balance quality grade such as \"G 6.3\"";
inline constexpr char array_of_places[] =
    "must be an array of tables, each begun by [[place]], with mass, radius and angle";
inline constexpr char array_of_bearings[] =
    "must be an array of tables, one a bearing, as [{ at = \"0.12 m\", stiffness = \"40 kN/m\", damping = \"300 N "
    "s/m\" }, ..]";
inline constexpr char array_of_unbalances[] =
    "must be an array of tables, one a plane, as [{ at = \"0.2 m\", size = \"50 g mm\", angle = \"0 degree\" }, ..]";
inline constexpr char bearings_state_it[] = "follows from rotor.tilt.bearings; give either these or that";
inline constexpr char bearings_hold_no_tilt[] =
    "must have a stiffness greater than 0 at two places at least, in x and in y: one place holds no tilt";
// Examples of both.
inline constexpr char across_and_tilt[] = "rotor.tilt.bearings, or [\"{}\", \"{}\"], or {{ x = [..], y = [..] }}";
inline constexpr char must_be_across_and_tilt[] = "must be [\"{}\", \"{}\"], or {{ x = [..], y = [..] }}";
// kg m^2
inline constexpr char couple_needs_slender_rotor[] =
    "is so near to transverse_inertia that the couple unbalance of {:.4g} kg m2 would turn the principal axis by more "
    "than 0.5 rad; must differ more";
inline constexpr char mass_includes_places[] = "must be greater than that of all places, {:.6g} kg: it includes them";
// The stiffness, lowest, highest.
inline constexpr char stiffness_out_of_range[] = "makes a stiffness of {:.3g} N/m; must make one from {} to {} N/m";
inline constexpr char pulled_too_far[] = "pulls the rotor farther than {} race radii; must be less";

// Balls. What it must be, of keys of which one is needed.
inline constexpr char race_radius[] = "a length greater than 0, such as \"60 mm\"";
inline constexpr char race_diameter[] = "such as \"120 mm\"";
inline constexpr char mass[] = "a mass greater than 0, such as \"5 g\"";
inline constexpr char ball_material[] = "such as \"steel\", with balancer.ball_diameter";
inline constexpr char drag[] =
    "a torque for a rate, such as \"1e-6 N m s\", or a force for a velocity, such as \"0.01 N s/m\"";
inline constexpr char oil[] = "such as { grade = \"ISO VG 32\", at = \"40 degC\" }";

// Balls: what is wrong.
inline constexpr char ball_fills_race[] = "must be less than the diameter of the race";
inline constexpr char needs_diameter[] = "needs balancer.ball_diameter, such as \"8 mm\"";
inline constexpr char unknown_material[] =
    "is not a material in the table (balancer.ball_density states any density); ";
inline constexpr char only_of_balls_that_roll[] = "has a meaning only with balancer.rolls = true";
inline constexpr char radius_or_diameter[] = "give either balancer.ball_radius or balancer.ball_diameter, not both";
inline constexpr char ball_radius_too_large[] = "must be less than the radius of the race";
inline constexpr char contact_angle_or_contact[] = "give either balancer.contact_angle or balancer.contact, not both";
inline constexpr char balls_of_one_diameter[] = "needs balls of one diameter";
// Diameter in mm, number of balls.
inline constexpr char balls_fill_race[] = "must be less than {:.6g} mm: at that size {} touching balls fill the race";
inline constexpr char stiction_below_rolling[] = "must be at least rolling, {}: a ball at rest resists no less";

// Oil.
inline constexpr char oil_grade[] = "a grade such as \"ISO VG 32\" or \"silicone 1000 cSt\"";
inline constexpr char viscosity_of_silicone_is_known[] =
    "applies to mineral oils only; leave it out for a silicone oil";
// Coldest and hottest in degC, whose law.
inline constexpr char oil_temperature[] =
    "must be from {:.6g} to {:.6g} degC: the law of {} holds there; beyond it give balancer.oil_viscosity";
inline constexpr char silicone_grade[] =
    "must be \"silicone\" with its viscosity at 25 degC, from {:.0f} to {:.0f} cSt, such as \"silicone 1000 cSt\"; for "
    "others give balancer.oil_viscosity";
// Empty, or did_you_mean_grade.
inline constexpr char unknown_oil[] =
    "{}must be \"ISO VG\" with a class of ISO 3448 from 2 to 3200, such as \"ISO VG 32\", or \"silicone\" with its "
    "viscosity at 25 degC, such as \"silicone 1000 cSt\"";
inline constexpr char did_you_mean_grade[] = "did you mean \"ISO VG {:.0f}\"? ";
inline constexpr char too_thin_for_index[] =
    "is thinner than viscosity indices are defined for; give viscosity_100, such as \"1.1 cSt\"";
// Viscosity at 40 degC.
inline constexpr char viscosity_at_100[] =
    "must be at least 0.5 cSt and less than the viscosity at 40 degC, {:.6g} cSt";
inline constexpr char only_with_oil[] = "has a meaning only with balancer.oil_viscosity or balancer.oil";
inline constexpr char needs_oil_density[] =
    "is a kinematic viscosity and needs balancer.oil_density, such as \"900 kg/m3\"";
// Least diameter in mm, largest part of the channel.
inline constexpr char channel_too_narrow[] =
    "must be at least {:.6g} mm: the wall correction holds for balls up to {} of the channel; in a closer fit measure "
    "the drag and state balancer.drag";

// Speed over time.
inline constexpr char profile_or_run_up[] =
    "give either speed.profile or speed.run_up, not both: run_up is a ramp to speed.final";
inline constexpr char run_up_or_duration[] = "give either speed.run_up or speed.duration, not both";
// Key, number of the entry, the entry before.
inline constexpr char out_of_order[] = "{} out of order: entry {} must be greater than {}";
// Number of entries, what each belongs to, how many must be there.
inline constexpr char one_entry_each[] = "has {} entries; must have one per {}, {}";
// The key before, its value.
inline constexpr char must_be_greater_than[] = "must be greater than {}, {}";
inline constexpr char must_be_at_least[] = "must be at least {}, {}";
inline constexpr char law_of_hill[] = "must be \"kinematic\": the rotor turns at the speed that a Hill function states";
inline constexpr char first_time[] = "the first time must be 0";

// Motor: torque and load.
inline constexpr char torque_missing[] = "missing; must be a table, as { constant = 0.12, slope = -0.04 }";
// Number of points, the most.
inline constexpr char points_of_curve[] = "has {} entries; must have 2 to {}";
inline constexpr char target_missing[] = "missing; must be a table like { profile = \"ramp\", ... }";
inline constexpr char speed_of_load_missing[] =
    "missing; must be the speed at which the load takes linear and quadratic";
inline constexpr char belongs_to_motor[] = "belongs to a motor: needs speed.torque";
inline constexpr char law_of_driven_rotor[] =
    "must be \"kinematic\": the speed of a driven rotor follows from its motor";
inline constexpr char inertia_of_driven_rotor[] =
    "must be a finite number greater than 0 for a driven rotor (profile \"torque\")";
inline constexpr char inertia_of_driven_rotor_in_units[] =
    "must be a moment of inertia greater than 0, such as \"0.02 kg m2\", for a driven rotor (profile \"torque\"), or "
    "give rotor.radius_of_gyration or rotor.gd2";

// Motor by its nameplate.
inline constexpr char synchronous_above_rated[] = "must be greater than speed.torque.rated_speed";
inline constexpr char no_synchronous_speed_fits[] =
    "is not within 10 % below a synchronous speed at 50 or 60 Hz; give speed.torque.synchronous_speed too";
inline constexpr char several_synchronous_speeds[] =
    "fits several synchronous speeds; give speed.torque.synchronous_speed, one of {}";
inline constexpr char belongs_to_nameplate[] = "belongs to a nameplate, which needs speed.torque.power or rated_torque";
inline constexpr char nameplate_or_torque[] =
    "give either a nameplate (speed.torque.power) or the torque itself, not both";
// Torque that the power stands for.
inline constexpr char torque_contradicts_power[] =
    "contradicts speed.torque.power, which is {:.4g} N m at the rated speed";
inline constexpr char breakdown_ratio_missing[] =
    "missing; must be the breakdown torque over the rated torque, such as 2.5";
inline constexpr char above_breakdown[] = "contradicts speed.torque.breakdown_ratio; must be at most {}";
inline constexpr char no_such_locked_rotor_ratio[] =
    "is not possible: at this rated speed and breakdown ratio the torque falls from standstill on; leave it out";

}  // namespace equipoise::words::machine
