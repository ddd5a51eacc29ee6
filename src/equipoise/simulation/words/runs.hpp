// Starts, ensembles and trajectories: what a study or a start must be, what came of it, what goes on.
// This room: the sentences of this chapter.
#pragma once

namespace equipoise::words::runs {

// A rotor that tilts.
inline constexpr char tilting_motor_holds_no_balls[] =
    "balls of a rotor with rotor.tilt that a motor drives are free from the beginning, without [release]";
inline constexpr char tilting_rotor_coasts[] =
    "with rotor.tilt starts of a rotor that coasts in the end cannot be decided (simulate follows one)";

// Studies that a command does not take. After file, key and value.
inline constexpr char uncertain_need_validated[] =
    "with uncertain values every start is followed to a motion of its own rotor; must be \"validated\"";
// Problem, the uncertain values at which it is met.
inline constexpr char corner[] = "{}; with {}";
// Release time, the latest that is watched.
inline constexpr char released_too_late[] =
    "holds the balls until t = {:.6g}, too long to watch for transients; must be release by about t = {:.3g}, or a "
    "study without [limits], its transients not asked for";
inline constexpr char final_speed_range[] =
    "basin and attractors take final speeds from -{0:g} to {0:g} critical speeds";
// Why proofs do not hold here.
inline constexpr char no_proof_decides[] = "{}; must be \"validated\" or \"horizon\"";
inline constexpr char no_balls[] =
    "leaves nothing to balance with; must be 1 to {} here: only basin, report, simulate and explain take a rotor "
    "without balls";
// Steps a start, its time, steps a unit of time, steps allowed.
inline constexpr char stiff[] =
    "makes the equations stiff: about {:.1g} steps a start, {:.2g} units of time with {:.3g} steps each; basin and "
    "attractors take up to {:.3g} here (or a shorter numerics.horizon)";
inline constexpr char grid_has_its_size[] =
    "sampling until a half-width needs \"random\" or \"sobol\": a grid is as large as `starts` says";
inline constexpr char grid_has_weights[] = "starts on a grid have weights; comparisons need \"random\" or \"sobol\"";
// One of the four below, most balls.
inline constexpr char no_starts_without_balls[] = "leaves no starts for {}; must be 1 to {} with that";
inline constexpr char an_output_file[] = "an output file";
inline constexpr char given_starts[] = "starts of one's own";
inline constexpr char a_half_width[] = "a half-width";
inline constexpr char the_grid_method[] = "sampling.method = \"grid\"";
inline constexpr char no_uncertain_value[] =
    "has no uncertain value; the sensitivity is that to values such as rotor.eccentricity = { uniform = [0.005, 0.015] "
    "}";

// Starts that are given, not drawn.
inline constexpr char all_are_followed[] = "all of them are followed; must be 0";
inline constexpr char not_drawn_here[] =
    "says how starts are drawn, which are given here; must be left out, or \"random\"";
inline constexpr char given_start_index[] = "must be below {}, their number";
inline constexpr char grid_start_index[] = "must be below {}, the starts of this grid";
inline constexpr char grid_start_count[] = "must be at most {}, the starts of this grid";
inline constexpr char angles_a_start[] = "must be {} a start";
inline constexpr char finite_numbers[] = "must be finite numbers";
inline constexpr char finite_number[] = "must be a finite number";
inline constexpr char finite_not_negative[] = "must be a finite number, 0 or more";
inline constexpr char no_such_ball[] = "must be 0: the study has {} balls";
inline constexpr char balls_are_clamped[] = "must be 0: the balls are clamped until their release";
// The value, why (one of the two below).
inline constexpr char as_in_initial[] = "must be {}, as in [initial], {}";
inline constexpr char rotor_is_prescribed[] = "where the rotor turns as prescribed, and its angle matters";
inline constexpr char prescribed_until_release[] = "where the rotor turns as prescribed until the balls are let go";
inline constexpr char balls_overlap[] = "balls overlap; must be at least {} rad apart, as balls are that touch";
// Two balls, their distance, the least distance.
inline constexpr char two_balls_overlap[] =
    "balls {} and {} overlap: {} rad apart; must be at least {} apart, as balls are that touch";
inline constexpr char no_uncertain_values[] = "is uncertain; starts of one's own need a study without uncertain values";
inline constexpr char known_by_numbers[] = "starts that draw their rotors are known by their numbers alone";

// Runs that ended early.
inline constexpr char stopped_before_start[] = "stopped before the start was decided";
inline constexpr char stopped_before_starts[] = "stopped before the starts were decided";
inline constexpr char stopped_before_attractors[] = "stopped before the attractors were known";
inline constexpr char clamped_not_integrated[] = "the clamped spin-up could not be integrated";
// Key, value.
inline constexpr char clamped_not_integrated_of[] =
    "the rotor could not be followed until the balls are let go; {} = {} may be too short or too long, or [initial] "
    "too far "
    "from rest";

// Notes of an ensemble.
inline constexpr char without_balls[] = "there are no balls";
inline constexpr char unknown_end[] =
    "no torque acts in the end, and the speed that the rotor then keeps is not known beforehand";
// Share, why.
inline constexpr char many_undecided[] = "{} are undecided: {}";
// Starts, a time, how many of them left, a rate and a lifetime.
inline constexpr char chaos_may_end[] =
    "long-lived chaos may end: of the {} starts that were in it, or on a slow approach, after {}, {} came to "
    "something else later, so they leave it at {}";
// Rate, its interval, unit of time; lifetime, its interval and its unit.
inline constexpr char leaves_at[] =
    "a rate of {:.2g} ({:.2g} to {:.2g}) per {} and its median lifetime is {:.2g} ({:.2g} to {:.2g}){}";
// The same without a start that left.
inline constexpr char leaves_below[] = "a rate below {:.2g} per {} and its median lifetime is above {:.2g}{}";
inline constexpr char unit_of_time[] = "unit of time", second[] = "second";
// How near the rotor came to the release.
inline constexpr char undecided_clamped[] = "balls of undecided starts are never let go: {}";
// The same.
inline constexpr char stalled_clamped[] = "balls of stalled starts are never let go: {}";
inline constexpr char keeps_turning[] =
    "the rotor keeps turning, at {:.2g} at least, and never comes to release.speed = 0";
// A fraction.
inline constexpr char comes_near_release[] = "the rotor comes to {:.2g} of release.speed at most";

// Why starts are undecided: what they do, how long they were followed. Counts first.
inline constexpr char near_balance[] = "{} near balance";
inline constexpr char creeping[] = "{} creeping, all balls nearly at rest";
inline constexpr char chaotic[] = "{} wandering chaotically";
inline constexpr char not_repeating[] = "{} in motions that do not repeat yet";
inline constexpr char never_let_go[] = "{} whose balls are never let go";
inline constexpr char running_away[] = "{} whose motor speeds the rotor up without end";
inline constexpr char speeding_up[] = "{} whose rotor still speeds up";
inline constexpr char changing_speed[] = "{} whose rotor still changes its mean speed";
inline constexpr char not_identified[] = "{} in steady motions that could not be identified";
inline constexpr char watched_too_short[] = "{} watched for too short a time to compare its parts";
inline constexpr char lyapunov[] = " (largest Lyapunov exponent {:.2g})";
// Number, the list of the above.
inline constexpr char examined[] = "of {} examined: {}";
// Time, who chose it.
inline constexpr char followed_for[] = "they were followed for {} ({})";
inline constexpr char never_settle[] = "balls without drag never settle";
// One of the three below, its rate, the horizon that it needs.
inline constexpr char slow[] = "{} at a rate of {:.2g}, so the horizon must be about {:.2g}";
inline constexpr char drag_damps[] = "drag damps the balls";
inline constexpr char balance_left[] = "balance is left";
inline constexpr char balance_approached[] = "balance is approached";
// The speed of the motor. After the speeds that were seen.
inline constexpr char aimed_at[] = " when last seen; the motor's target is {}";
inline constexpr char stalls_alone[] =
    "; even without balls the rotor stalls at {}, where its own unbalance takes the motor's power";
// Speed, time, what follows or nothing.
inline constexpr char run_up_takes[] =
    "; a run-up to {} takes about {} with the power that the rotor's own unbalance takes{}";
inline constexpr char longer_than_followed[] = ", longer than they were followed";

// Results that are compared, or read back.
inline constexpr char different_balls[] = "they have different numbers of balls";
inline constexpr char different_starts[] = "they were not given the same starts";
inline constexpr char different_seeds[] = "their seeds differ";
inline constexpr char different_methods[] = "their sampling methods differ";
inline constexpr char different_room[] = "their contact angles differ";
inline constexpr char different_boxes[] = "their sampling boxes differ";
// Start, instruction sets of the file, the one in use.
inline constexpr char other_results[] =
    "start {}, computed with {}, has another result in this program with {}; must be a new file, or one that this "
    "program and instruction set made";
inline constexpr char not_an_outcome[] = "must be an outcome that basin() returned";
inline constexpr char not_all_starts[] = "of {} starts; must be all (keep_starts), and one or more";

// Attractors from elsewhere.
inline constexpr char map_of_one_rotor[] =
    "was made for one rotor, and this study draws a rotor for every start; must be left out";
inline constexpr char map_not_searched[] =
    "starts of a rotor that coasts are followed without a search; must be left out";
inline constexpr char map_of_another_search[] =
    "of another search: {}; must be a mapper of the same rotor, final speed and [numerics]";
inline constexpr char map_of_another_cpu[] = "searched with {}, and starts are followed with {}; must be the same cpu";

// Settings of observations and trajectories.
inline constexpr char one_or_more[] = "must be 1 or more";
inline constexpr char finite_above_zero[] = "must be finite, above 0";
inline constexpr char room_for_a_window[] = "must be finite and leave room for one window";
inline constexpr char time_range[] = "must be a number from 0 to 1e9";
inline constexpr char step_range[] = "must be a number greater than 0, at most 1e9";
inline constexpr char too_many_rows[] = "makes more than {:.0f} rows; must be at least {}";
inline constexpr char times_out_of_order[] = "times out of order: must be later than the time before it, {}";
inline constexpr char equations_of_one_rotor[] =
    "is uncertain; equations are those of one rotor: with_medians() or drawn_study()";
inline constexpr char contact_needs_events[] =
    "balls that meet need events, as simulate() has them; must be 0, or contact = false";
inline constexpr char sticking_needs_events[] = "balls that stick need events, as simulate() has them; must be 0";
inline constexpr char no_release_speed[] = "is not what lets the balls go; must be that of a driven rotor";
inline constexpr char no_such_cpu[] = "must be one of those this program is built for and this machine has: {}";

// Progress.
inline constexpr char looking_for_attractors[] = "looking for attractors";
inline constexpr char balanced_states[] = "balanced states";
inline constexpr char pilot_trajectories[] = "pilot trajectories";
inline constexpr char motions_followed[] = "motions followed until they are steady";
inline constexpr char starts_searched[] = "starts searched";
inline constexpr char sensitivity_rows[] = "rows of the sensitivity";

// How an instruction set rounds. Files of results hold these words: with others, older files are of another machine.
inline constexpr char fused[] = "with fused multiply-add (AVX2, AVX-512)";
inline constexpr char fused_where_written[] = "with fused multiply-add where it is written (AVX2, AVX-512, NEON)";
inline constexpr char not_fused[] = "without fused multiply-add (SSE4, scalar)";

}  // namespace equipoise::words::runs
