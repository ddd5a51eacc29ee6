// Titles, labels and legends of plots and drawings.
#pragma once

namespace equipoise::words::plots {

// Titles.
inline constexpr char partial_early[] = " (PARTIAL: stopped early)";
// Key, percentage, what starts do, whether partial.
inline constexpr char largest_at_which[] = "Largest {} at which {:.4g} % of starts {}{}";
// Objectives, whether partial.
inline constexpr char design_for[] = "Design for {}{}";
inline constexpr char partial_cells[] = " (PARTIAL: cells are missing)";
inline constexpr char angles_drawn[] = ", ball angles drawn at every point";
inline constexpr char stopped_early[] = "PARTIAL: stopped early";

// Axes.
inline constexpr char final_speed[] = "final rotor speed Ω / √(k/M)";
inline constexpr char eccentricity[] = "eccentricity λ / race radius";
inline constexpr char damping[] = "external damping ζ = c / √(k M)";
inline constexpr char stiffness[] = "support stiffness κ";
inline constexpr char ball_mass[] = "mass of a ball μ / rotor mass";
inline constexpr char ball_drag[] = "drag of a ball β";
// Ball.
inline constexpr char initial_angle[] = "initial angle of ball {0}, φ{0} (rad)";
// Ball.
inline constexpr char initial_rate[] = "initial rate of ball {0}, φ{0}' / √(k/M)";
// x or y.
inline constexpr char initial_place[] = "initial {} / race radius, rotating frame";
// x or y.
inline constexpr char initial_velocity[] = "initial {}' / (race radius x √(k/M))";
// Label, lowest, highest.
inline constexpr char axis_from_to[] = "{} from {:.4g} to {:.4g}";
inline constexpr char share_of_starts[] = "share of starts, %";
inline constexpr char rotor_displacement[] = "rotor displacement r / race radius";
inline constexpr char trajectories_followed[] = "trajectories followed";

// Legends.
inline constexpr char balance_ends[] = "balance ceases to exist";
inline constexpr char unstable[] = "unstable";
inline constexpr char balanced_interval[] = "balanced: 95 % interval";
inline constexpr char balance_changes[] = "stability of balance changes";
inline constexpr char balanced_share[] = "balanced share";
inline constexpr char must_hold[] = "must hold";
inline constexpr char not_beaten[] = "not beaten by any";
inline constexpr char balls_let_go[] = "balls let go";
inline constexpr char best_so_far[] = "best so far";
inline constexpr char most_stay_below[] = "90 % of starts stay below";
inline constexpr char diverged_or_failed[] = "diverged or failed";
inline constexpr char worst_of[] = "worst of {} starts";
inline constexpr char typical_half_lower[] = "typical start, half peak lower";
inline constexpr char at_the_end[] = " at the end";

// Below drawings.
inline constexpr char smallest_to_largest[] =
    "Every motion from its smallest to its largest displacement: a band where it attracts.";

// What drawings show, for those who cannot see them.
inline constexpr char shares_by_outcome[] = "Shares of starts by outcome, with their intervals";
inline constexpr char distribution_of[] = "Distribution of the {}";
inline constexpr char displacement_over_time[] = "Displacement of the rotor over time, with and without balls";
inline constexpr char speed_over_time[] = "Speed of the rotor over time";
inline constexpr char balls_and_centre[] = ": balls in the race and the way of the rotor's centre";
inline constexpr char balls_and_shaft[] = ": balls in their races and the way of the shaft";
inline constexpr char outcome_at_points[] = "Outcome of the start at every point of the plane";
inline constexpr char shares_along[] = "Shares of starts by outcome along the parameter";
inline constexpr char where_rotor_ends[] = "Where the rotor can end";
inline constexpr char share_over_two[] = "Balanced share of the starts over two parameters";

// Faults.
inline constexpr char squares_disagree[] = "a picture's squares, size and palette do not agree";

// Progress.
inline constexpr char drawing_motions[] = "drawing the motions";
inline constexpr char following_runs[] =
    "following the rotor without balls, the typical run and the worst in a hundred";

}  // namespace equipoise::words::plots
