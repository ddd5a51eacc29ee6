// What is said of the curves in a plane of two parameters on which balance changes.
#pragma once

namespace equipoise::words::chart {

// Input.
inline constexpr char undecided_range[] = "must be a part of the plane in percent, more than 0 and less than 100";

// Files.
inline constexpr char file[] = "must be a new file, or one that \"chart -o\" wrote";
inline constexpr char no_such_file[] = "holds no chart; {}";
inline constexpr char these_results[] = "this chart of this study";
inline constexpr char file_title[] = "curves in a plane of two parameters on which balance and locked states change";

// The answer: how balance is lost on Hopf curves. Percent.
inline constexpr char no_loss[] = "No line on which a stable balance loses its stability was found.";
inline constexpr char softly[] =
    "Where balance loses its stability it does so softly: beyond the line the balls swing about their places, little "
    "at "
    "first and the more the farther from it.";
inline constexpr char abruptly[] =
    "Where balance loses its stability it does so abruptly: beyond the line no small swing is left, and the balls "
    "leave "
    "for another motion; shortly before it a push may be enough.";
inline constexpr char both_ways[] =
    "Balance loses its stability softly along {} of the line, where beyond it the balls swing about their places, "
    "little "
    "at first and the more the farther from it. Along {} it does so abruptly: beyond the line no small swing is left, "
    "and "
    "the balls leave for another motion; shortly before it a push may be enough.";
inline constexpr char way_unknown[] =
    "Where balance loses its stability the balls begin to swing; whether softly or abruptly is not told of balanced "
    "states that form a continuum, nor under a motor.";
inline constexpr char real_loss[] = "On another line balance loses its stability without a swing.";
inline constexpr char balance_ends[] =
    "On the line where balance ends all balls stand in line, and their states merge.";
inline constexpr char balance_ends_in_a_plane[] =
    "On the line where balance ends all balls of one plane stand in line, and states merge.";

// The proof. Percent each.
inline constexpr char proved[] = "Proved by interval arithmetic: {}; {} of the plane is not decided.";
inline constexpr char proved_stable[] = "stable all over {}";
inline constexpr char proved_unstable[] = "unstable all over {}";
inline constexpr char proved_none[] = "impossible all over {}";
inline constexpr char proved_nothing[] = "Interval arithmetic proved nothing.";
// Why.
inline constexpr char not_proved[] = "Nothing is proved: {}.\n";
inline constexpr char rotor_not_proved[] =
    "proofs are of two balls with equal drag that slide freely in a centred race, at a prescribed speed and without "
    "tilt";
inline constexpr char keys_not_proved[] = "a key of the axes is not itself a parameter of the equations";
inline constexpr char boxes_used_up[] = "More boxes (--boxes) would decide more of the plane.\n";

// Tables.
inline constexpr char curve[] = "curve";
inline constexpr char what_crosses[] = "what it is";
inline constexpr char from_place[] = "from";
inline constexpr char to_place[] = "to";
inline constexpr char frequency[] = "frequency";
inline constexpr char of[] = "of";
inline constexpr char how[] = "what is lost";
inline constexpr char is_hopf[] = "Hopf";
inline constexpr char is_zero[] = "real eigenvalue";
inline constexpr char is_existence[] = "balance ends";
inline constexpr char is_fold[] = "fold";
inline constexpr char is_pitchfork[] = "pitchfork";
inline constexpr char is_cycle_fold[] = "fold of cycles";
inline constexpr char is_cycle_flip[] = "period doubling";
inline constexpr char is_cycle_torus[] = "torus";
inline constexpr char how_softly[] = "softly";
inline constexpr char how_abruptly[] = "abruptly";
inline constexpr char how_both[] = "softly, abruptly";
inline constexpr char how_before[] = "nothing: unstable before";
inline constexpr char how_real[] = "without a swing";
inline constexpr char how_ends[] = "it ends";
inline constexpr char how_unknown[] = "not known how";
inline constexpr char how_stable_state[] = "a stable state";
inline constexpr char how_unstable_states[] = "unstable states";
inline constexpr char how_stable_cycle[] = "a stable cycle";
inline constexpr char how_unstable_cycles[] = "unstable cycles";
inline constexpr char how_both_cycles[] = "a cycle, stable on a part";
inline constexpr char place[] = "at";
inline constexpr char meaning[] = "what it is";
inline constexpr char is_generalised_hopf[] = "generalised Hopf: softly on one side, abruptly on the other";
inline constexpr char is_double_hopf[] = "double Hopf: two swings begin at once";
inline constexpr char is_zero_hopf[] = "zero-Hopf: a swing begins where a real eigenvalue is 0";
inline constexpr char is_bogdanov_takens[] = "Bogdanov-Takens: the swing's frequency falls to 0";
inline constexpr char is_cusp[] = "cusp: two folds meet";
inline constexpr char is_fold_hopf[] = "fold-Hopf: a swing begins where two states merge";
inline constexpr char is_cycle_cusp[] = "cusp: two folds of cycles meet";
inline constexpr char is_resonance_1_1[] = "1:1 resonance: a second multiplier is 1";
inline constexpr char is_resonance_1_2[] = "1:2 resonance: a second multiplier is -1";
inline constexpr char is_resonance_1_3[] = "1:3 resonance: the torus closes after three turns";
inline constexpr char is_resonance_1_4[] = "1:4 resonance: the torus closes after four turns";
inline constexpr char is_fold_flip[] = "fold-flip: cycles merge where their period doubles";
inline constexpr char is_fold_torus[] = "fold-torus: cycles merge where a torus is born";
inline constexpr char is_flip_torus[] = "flip-torus: a period doubles where a torus is born";
inline constexpr char is_double_torus[] = "double torus: two swings begin about a cycle";
inline constexpr char is_generalised_flip[] = "generalised doubling: softly on one side, abruptly on the other";

// Locked states, by where the balls are. Numbers of balls, or their numbers.
inline constexpr char one_ball[] = "ball on the line";
inline constexpr char together[] = "balls together";
inline constexpr char opposite[] = "balls opposite";
inline constexpr char alike_against[] = "{} balls against {}";
inline constexpr char balls_against[] = "balls {} against {}";
// Why they are not known.
inline constexpr char locked_of_plain_rotors[] =
    "they are known of rotors that do not tilt, with a centred race, equal supports and no gravity";
inline constexpr char locked_without_events[] = "balls that touch or stick may rest anywhere";
inline constexpr char locked_under_drive[] = "without a drive that lasts no speed is kept";
inline constexpr char too_many_kinds[] = "unlike balls can be divided in too many ways";

// Why cycles are not known.
inline constexpr char cycles_without_events[] = "balls that touch or stick make them break off";

// Regions: what is there, a place.
inline constexpr char region_at[] = "{} (e.g. at {}, {})";
// What balance is; of other states how many, if more than one.
inline constexpr char region_balance[] = "balance {}";
inline constexpr char region_locked[] = "{} {}{}";
inline constexpr char region_count[] = " ({})";
inline constexpr char more_regions[] = "Smaller regions are left out ({}); --json has them.\n";
inline constexpr char regions_are[] =
    "Regions tell of states at rest, as the grid's points have them, not of motions that go on.\n";
// Why.
inline constexpr char no_locked[] = "Of other states at rest nothing is told: {}.\n";

// Why.
inline constexpr char no_cycles[] = "Of cycles nothing is told: {}.\n";

// Numbers of curves of states at rest.
inline constexpr char curves_lost[] =
    "Curves that end inside the plane because no next point was found, by number: {}.\n";
inline constexpr char lost_to_another_state[] =
    "Where another balanced state becomes the most stable one a curve may end so.\n";

// How curves of cycles end: the places, each with the numbers of the curves.
inline constexpr char cycles_end[] = "Curves of cycles end, by number: {}.\n";
inline constexpr char cycles_end_at[] = "{} ({})";
inline constexpr char end_plane[] = "at the plane's edge";
inline constexpr char end_closed[] = "at their own beginning";
inline constexpr char end_lost[] = "where no next point was found";
inline constexpr char end_single_cycle[] =
    "where the cycle is a single one passed twice, on a curve of period doublings";
inline constexpr char end_vanishes[] = "where the cycle shrinks to a state at rest";
inline constexpr char end_long_period[] =
    "where its period grows beyond {:g} turns and twice that at birth, near a homoclinic orbit";
inline constexpr char end_resonance[] = "where a torus has a resonance 1:1 or 1:2";
inline constexpr char end_points[] = "after {} points each way";
inline constexpr char end_multiplier[] = "where a multiplier grows beyond {:.0e}";
inline constexpr char end_stopped[] = "where the computation was stopped";

// Notes.
inline constexpr char no_curve[] = "No curve was found.\n";
inline constexpr char places_are[] = "Places are {}, {}; frequencies are in omega_c.\n";
// Key of an axis, unit.
inline constexpr char axis_in_unit[] = "{} in {}";
// Error, part of the plane's sides.
inline constexpr char precise[] = "Points lie on their curves within {:.0e} of the plane's sides.\n";
inline constexpr char contact_bound[] = "Where balance ends because the balls lack room, no curve is drawn.\n";
inline constexpr char partial_cycles[] =
    "PARTIAL: stopped while curves of cycles were followed; at least {} place{} where cycles change {} left.\n";
inline constexpr char partial[] = "PARTIAL: stopped before all curves and boxes were done.\n";
// First line of an incomplete table of curves: version, that it is partial.
inline constexpr char csv_partial[] = "# equipoise {}: chart{}\n";
// Progress: branches of cycles, with the curves that begin on them.
inline constexpr char cycles_followed[] = "cycles";
// Points, boxes, time, version.
inline constexpr char made_with[] = "{} curve{}, {} boxes; {}; equipoise {}\n";

// Pictures.
inline constexpr char curves_of_change[] = "Curves on which balance and locked states change";
inline constexpr char legend_soft[] = "balance is lost softly";
inline constexpr char legend_abrupt[] = "balance is lost abruptly";
inline constexpr char legend_hopf[] = "a swing begins";
inline constexpr char legend_zero[] = "a real eigenvalue crosses";
inline constexpr char legend_existence[] = "balance ends";
inline constexpr char legend_proved[] = "proved: {}";
inline constexpr char legend_fold[] = "two locked states merge";
inline constexpr char legend_pitchfork[] = "balls of a locked state part";
inline constexpr char legend_locked_hopf[] = "a locked state begins to swing";
inline constexpr char legend_cycle_fold[] = "two cycles merge";
inline constexpr char legend_cycle_flip[] = "a cycle's period doubles";
inline constexpr char legend_cycle_torus[] = "a cycle becomes a torus";
inline constexpr char legend_regions[] = "at rest and stable:";
inline constexpr char legend_no_region[] = "nothing";
inline constexpr char legend_open[] = "not decided";
inline constexpr char legend_special[] = "where curves change their kind";

}  // namespace equipoise::words::chart
