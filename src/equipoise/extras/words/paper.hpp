// The paper of Wright and Peng (2019), computed again: its tables and figures, and what comes of them.
// This room: the sentences of this chapter.
#pragma once

namespace equipoise::words::paper {

// The paper.
inline constexpr char citation[] =
    "J. A. Wright and L. Peng, An automatic dynamic balancer in a rotating mechanism with time-varying angular "
    "velocity, Results in Applied Mathematics (2019), arXiv:1906.04823";
inline constexpr char built_without[] = "{}: the library was built without it";
inline constexpr char sum_of_row[] = "the printed row sums to {:.2f}";
inline constexpr char no_reading_fits[] =
    "the printed shares follow from no reading of the paper's text that was tried";

// Titles of its tables.
inline constexpr char table_1[] = "constant speed, four values of the balls' drag";
inline constexpr char table_3[] = "ramp 0 to 2.4 in T0, balls released at 2.4";
inline constexpr char table_4[] = "ramp 0 to Omega_f in T0 = 500, balls released at Omega_f";
inline constexpr char table_5[] = "ramp 0 to 2.4 in T0, balls released at 2.2";
inline constexpr char table_6[] = "ramp 0 to 5 in T0, balls released at 2 or at 3";
inline constexpr char table_7[] = "0 to 3 until T0, 3 until T1, 3 to 2 until T2; balls released at 3";

// Figures: titles, captions, and what a caption leaves open.
inline constexpr char no_duration_in_caption[] =
    "The caption gives no T0. Chosen: T0 = 500, the duration that the paper fixes for its table 4 and that its tables "
    "5 and 6 share.";
inline constexpr char attractors[] = "The vibrating attractors V1 to V4";
inline constexpr char attractors_caption[] =
    "Radial displacement r against time on the motions other than balance, at constant speed; β = 0.05, ζ = 0.5. V1: "
    "balls coincident; V2: a torus, never quite repeating; V3: one ball captured; V4: the same with four times the "
    "period.";
inline constexpr char transients[] = "Transients after ramps of six durations";
inline constexpr char transients_caption[] =
    "r against time: ramp 0 to 2.4 in T0, balls clamped at φ = −π/2, π/2 and released at 2.4; β = 0.05, ζ = 0.5.";
inline constexpr char opposite_balls[] =
    "The caption starts both balls at −π and π, which is one point; −π/2 and π/2, as in the later figures, makes them "
    "opposite, as the text says.";
inline constexpr char ball_lag[] = "Ball lag: released at the end of the ramp or on the way";
inline constexpr char ball_lag_caption[] =
    "r against time: ramp 0 to 5, balls at φ = −π/2, π/2 released at 5 (i) and at 2 (ii); β = 0.01, ζ = 0.02. Balls "
    "released early lag behind the rotor while it speeds up.";
inline constexpr char release_caption[] =
    "r against time: ramp 0 to 2.4, balls at φ = −π/2, π/2 released at 2.4 (i) and at 2.2 (ii), for four pairs of "
    "external and internal damping.";
inline constexpr char data_of_figure[] =
    "# r: distance of the rotor's centre from the axis, in race radii; t in 1/omega_c. Long curves are thinned to "
    "their envelope.\n";
inline constexpr char known_parts[] =
    "must be among {}; studies/publications/judge.py has the numbers of other publications";
inline constexpr char known_figures[] = "must be one of paper_figure_ids()";

// Names of studies and maps of the paper's open questions.
inline constexpr char study_at_speed[] = "future work at speed {}";
inline constexpr char map_over_angle[] = "map of eccentricity and angle";
inline constexpr char map_over_mass[] = "map of eccentricity and mass";
inline constexpr char rest_at_speed[] = "starts at rest at speed {}";

// Axes and legends.
inline constexpr char ramp_duration[] = "duration of the ramp, T0";
inline constexpr char final_speed[] = "final speed Ω / critical speed";
inline constexpr char starts_in_box[] = "starts in the box";

// Why a cell is not compared.
inline constexpr char not_computed[] = "not computed under the published law";
inline constexpr char stopped_early[] = "stopped before all starts were done";
inline constexpr char table_7_stopped[] = "stopped before table 7 was observed";
inline constexpr char folder_must_be_writable[] = "must be a folder that can be written to";

// The report in the terminal.

// Row, attractor, p value, starts at first, starts taken.
inline constexpr char sampled_further[] = "{}, {}: p = {:.2g} from the first {} starts, so {} were taken";
// Cells that agree, differ, "s" or nothing, not comparable, below 0.01, expected; starts, undecided, lost.
inline constexpr char cells_of_table[] =
    "{} cells agree, {} differ{}, {} not comparable; {} of the judged below p = 0.01 ({:.1f} expected by chance). {} "
    "starts, {} undecided, {} lost.\n\n";
inline constexpr char judged_jointly[] =
    "Judged jointly over each table at 99 % by the errors of both samples, under the published law.\n";
inline constexpr char lead_on_table_7[] =
    "Table 7, the best lead (docs/evidence/table-7.md; fitted to the printed shares, not claimed): kinematic law, "
    "balls released at 2.2, balanced if r < 0.00134 from t = 630 to 730\n";
inline constexpr char open_questions[] =
    "Open questions: balanced share of starts in a box of the whole state space, and at rest\n";
// Percent.
inline constexpr char kinematic_share[] = "kinematic law {}";
// Conclusion, table, answers by both laws.
inline constexpr char one_conclusion[] = "  {} (table {}).\n    published law: {}; kinematic law: {}\n";
inline constexpr char conclusions[] =
    "What the printed numbers say, asked of both speed laws (differences of balanced shares in points, 99 %, common "
    "starts):\n{}\n";
// Seconds, CPU seconds, version.
inline constexpr char this_run[] = "This run, all else included: {:.0f} s, {:.0f} s CPU; equipoise {}\n";
inline constexpr char partial[] = "PARTIAL: stopped before all was done.\n";

}  // namespace equipoise::words::paper
