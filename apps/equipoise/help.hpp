// The help of every command and option, by their names.
#pragma once

namespace equipoise::app::help {

// The program.
inline constexpr char program[] = "Will this automatic balancer balance this rotor, how surely and how fast?";
inline constexpr char exit_codes[] =
    "Exit codes: 0 done, 1 failed, 2 bad usage or study, 3 not proved or damaged, 4 out of time (--within) with a "
    "partial answer, 130 interrupted with results kept.\nData go to standard output, all else to standard error.";

// Options of several commands.
inline constexpr char study[] = "study file (TOML)";
inline constexpr char starts[] = "number of starts";
inline constexpr char seed[] = "seed of the starts";
inline constexpr char zip[] = "the parameters vary together, step by step, instead of in all combinations";
inline constexpr char set[] = "override a study key, e.g. speed.final=2.6; may be repeated";
inline constexpr char no_changes[] =
    "do not try changes to a balancer that falls short (up to eight, on up to 100 starts each)";
inline constexpr char wide[] = "every column, without line breaks";
inline constexpr char details[] = "also how starts were decided, and every figure of every outcome with its interval";
inline constexpr char threads[] = "threads (default: all cores)";
inline constexpr char cpu[] = "instruction set to use instead of the best (see --version)";
inline constexpr char within[] =
    "stop after this time with what is known by then, marked partial: 90, 60s, 10min, 1.5h";
inline constexpr char quiet[] = "no progress";
inline constexpr char json[] = "print one JSON object";
inline constexpr char report[] = "the same as a page to take to a meeting: one file that needs nothing else";
inline constexpr char plot[] = "a picture";
inline constexpr char parameter_x[] =
    "what varies from left to right: a key of rotor, balancer or speed that takes a number, and its range, e.g. "
    "speed.final=0.5:6, \"speed.final=900 rpm:4000 rpm\" (default speed.final)";
inline constexpr char parameter_y[] = "the same from bottom to top (default balancer.drag)";
inline constexpr char x_range[] = "the range of --x, where it names only a key";
inline constexpr char y_range[] = "the same for --y";

namespace attractors {
inline constexpr char about[] = "every steady motion of the final speed: refined, named, with its share";
inline constexpr char starts[] = "starts to search (default {})";
inline constexpr char seed[] = "seed of the random starts";
inline constexpr char state[] =
    "also follow this state, for attractors too rare to be met by chance: x,y,u,v, ball angles, ball rates, as "
    "\"state\" in --json prints them; may be repeated";
inline constexpr char along[] =
    "follow every attractor along a study key, e.g. speed.final=1.4:6.5:0.05, or in a study with units "
    "\"speed.final=900 rpm:4000 rpm:50 rpm\"; with --starts: that many searched at every value besides the pilot's";
inline constexpr char output[] = "with --along: one line per value and attractor (.csv), or the same as NetCDF (.nc)";
inline constexpr char plot[] = "with --along: a picture of r_min to r_max";
}  // namespace attractors

namespace basin {
inline constexpr char about[] = "shares of starts that end in each attractor, with intervals";
inline constexpr char starts[] = "number of starts (with --half-width: at most so many)";
inline constexpr char half_width[] = "sample until every share's 95 % interval is within +- H (a fraction of one)";
inline constexpr char sensitivity[] =
    "what balance depends on most, of a study with uncertain values: Sobol indices from N rows of starts";
inline constexpr char start_index[] = "replay start I alone and print its angles and outcome";
inline constexpr char decide[] = "grounds of decision: validated (default), proof (of balance) or horizon";
inline constexpr char output[] = "per-start results (NetCDF); the same command resumes or extends them";
inline constexpr char transients[] =
    "peak vibration, bearing force, settling time and other transients (default where the study has [limits] or "
    "[standards], or is in physical units)";
inline constexpr char no_transients[] = "leave these out, and with them the verdict";
inline constexpr char report[] = "the same as a page to take to a meeting (see report); with --transients";
}  // namespace basin

namespace capacity {
inline constexpr char about[] = "the largest unbalance, or other parameter, at which a stated share of starts balances";
inline constexpr char of[] =
    "the parameter to maximise, any key that --set takes (default: the unbalance, in g mm of a study in physical "
    "units, else rotor.eccentricity)";
inline constexpr char between[] =
    "range to search, e.g. 0.001:0.1 or \"20 g mm:400 g mm\" (default for an unbalance: up to what all balls together "
    "can make up for)";
inline constexpr char by[] =
    "what a start must do: balanced (default), limits (keep all of [limits]), or one limit by its name";
inline constexpr char at_least[] = "share of starts that must do it (default 0.95)";
inline constexpr char precision[] = "to what part of the range it is located (default 0.005)";
inline constexpr char over[] = "a parameter and its values, as of equipoise sweep; up to three times";
inline constexpr char starts[] = "number of starts of every ensemble (default 10000)";
inline constexpr char seed[] = "seed of the starts, which are the same in all";
inline constexpr char output[] =
    "all cells as NetCDF (.nc), their trials kept as they come; the same command goes on from it";
inline constexpr char csv[] = "one line per cell (.csv)";
}  // namespace capacity

namespace certify {
inline constexpr char about[] = "a proof that trajectories near balance end balanced, or the check of one";
inline constexpr char check[] = "verify a certificate's file instead, from its own data";
inline constexpr char output[] = "write the certificates here";
}  // namespace certify

namespace check {
inline constexpr char about[] = "what was understood of a study, what was assumed, and which estimate matters most";
}  // namespace check

namespace compare {
inline constexpr char about[] = "two studies or results on common starts: how much more often the second balances";
inline constexpr char first[] = "study file (TOML), or a result of basin -o (.nc)";
inline constexpr char second[] = "study file or result that is compared with it";
inline constexpr char starts[] = "number of starts of both";
inline constexpr char seed[] = "seed of the starts of both";
inline constexpr char set_second[] = "override a key of the second study only; may be repeated";
inline constexpr char transients[] =
    "also compare peaks, forces, settling time and other transients (default where a study has [limits])";
}  // namespace compare

namespace design {
inline constexpr char about[] = "the best balancer or spin-up among allowed choices, with margins and evidence";
inline constexpr char study[] = "study file (TOML); without a [design] one is proposed and taken";
inline constexpr char best[] = "write the chosen design as a study that every other command takes";
inline constexpr char trajectories[] =
    "budget (default: design.trajectories, else 2000000; a proposed [design] states its own)";
inline constexpr char seed[] = "seed of the starts, which are the same for all candidates";
inline constexpr char output[] = "all ensembles as NetCDF (.nc), kept as they come; the same command goes on from it";
inline constexpr char csv[] = "one line per member of the front (.csv)";
}  // namespace design

namespace explain {
inline constexpr char about[] = "a study in physical and dimensionless form, and what follows without simulation";
inline constexpr char cost[] =
    "also how long basin takes, measured on a part of it: the search for attractors and the first starts";
inline constexpr char within[] = "of --cost: the longest that this may take (default 10s)";
}  // namespace explain

namespace inspect {
inline constexpr char about[] = "what a file of results holds, how complete and whether damaged";
inline constexpr char file[] = "file of results (.nc), or the unfinished part of one (.nc.part)";
}  // namespace inspect

namespace map {
inline constexpr char about[] = "the outcome of a start at every pixel of a plane of two quantities";
inline constexpr char x[] =
    "what varies from left to right: a key of rotor, balancer, speed, release or initial that takes a number, and its "
    "range, e.g. initial.phi_1=-pi/2:pi/2 (default initial.phi_1; ball angles: a whole turn)";
inline constexpr char y[] = "the same from bottom to top (default initial.phi_2)";
inline constexpr char size[] = "pixels (default 512x512)";
inline constexpr char tie[] = "a ball angle that follows another, e.g. phi_2=phi_1+pi; may be repeated";
inline constexpr char output[] =
    "every pixel's outcome and time as NetCDF (.nc), kept as they come; the same command resumes, and reads what is "
    "there";
inline constexpr char plot[] = "a picture, darker where decided later";
}  // namespace map

namespace merge {
inline constexpr char about[] = "joins files of one sweep from several machines or runs";
inline constexpr char files[] = "files of one sweep (.nc), or unfinished parts of them (.nc.part)";
inline constexpr char output[] = "the merged file (.nc)";
}  // namespace merge

namespace new_study {
inline constexpr char about[] = "a commented study to start from: a washing machine, a fan, any machine";
inline constexpr char machine[] = "one of: {}";
inline constexpr char output[] = "write it here instead of to standard output; must be a new file";
}  // namespace new_study

namespace report_page {
inline constexpr char about[] = "a page on one machine for two printed sheets: verdict, shares, motions, peaks, runs";
inline constexpr char output[] = "page to write: one file that needs nothing else";
}  // namespace report_page

namespace reproduce {
inline constexpr char about[] = "what Wright and Peng (2019) published, computed again and judged";
inline constexpr char what[] = "any of {} (default: all), separated by blanks or commas";
inline constexpr char starts[] = "starts per ensemble (default: as many as the paper used)";
inline constexpr char law[] = "speed law of ramps (default: both)";
inline constexpr char report[] = "one page with everything (HTML)";
inline constexpr char explorer[] =
    "path of the explorer's page relative to the report, whose rows then link to their settings there";
inline constexpr char output[] = "folder for ensembles, pictures and tables; the same command resumes";
inline constexpr char pixels[] = "pixels along each side of the maps of `future` (default: 64)";
}  // namespace reproduce

namespace simulate {
inline constexpr char about[] = "one trajectory at stated times";
inline constexpr char at[] = "times, separated by commas (in 1/omega_c, or with units: 2 s)";
inline constexpr char every[] = "time between rows (the same)";
inline constexpr char until[] = "last time (the same)";
inline constexpr char tolerance[] = "relative error allowed per step (default 1e-12)";
inline constexpr char output[] = "write here (.csv or .nc) instead of CSV on standard output";
inline constexpr char set[] = "override a study key, e.g. initial.phi=[1.0,4.0]; may be repeated";
}  // namespace simulate

namespace chart {
inline constexpr char about[] =
    "curves in a plane of two parameters on which balance changes, and what is proved beside";
inline constexpr char size[] = "points of the grid from which curves begin (default 64x64)";
inline constexpr char boxes[] = "most boxes that proofs may try (default 200000); 0: prove nothing";
inline constexpr char undecided[] = "proofs end when no more of the plane than this is undecided (default 1)";
inline constexpr char cycles[] = "also curves on which the cycles born on Hopf curves change; takes up to minutes";
inline constexpr char output[] = "curves, points and boxes as NetCDF (.nc)";
inline constexpr char csv[] = "one line per point of a curve (.csv)";
inline constexpr char plot[] = "a picture of curves, points and boxes";
}  // namespace chart

namespace stability {
inline constexpr char about[] = "where balance is stable in a plane of two parameters, by eigenvalues alone";
inline constexpr char size[] = "points (default 512x512)";
inline constexpr char output[] = "all points as NetCDF (.nc)";
inline constexpr char csv[] = "one line per point (.csv)";
inline constexpr char plot[] = "a picture shaded by decay and growth, with the boundaries by their kind";
}  // namespace stability

namespace sweep {
inline constexpr char about[] = "shares at every combination of some parameters' values";
inline constexpr char over[] =
    "a parameter and its values, e.g. speed.final=1.5:6:0.1, balancer.drag=0.01,0.05,0.1, \"speed.final=900 rpm:4000 "
    "rpm:100 rpm\"; up to three times (default: what [sweep] of the study says)";
inline constexpr char starts[] = "number of starts of every cell (with --half-width: at most so many)";
inline constexpr char seed[] = "seed of the starts, which are the same in every cell";
inline constexpr char half_width[] =
    "sample in every cell until every share's 95 % interval is within +- H (a fraction of one)";
inline constexpr char transients[] = "peak vibration and other transients (default where the study has [limits])";
inline constexpr char output[] = "all cells as NetCDF (.nc), kept as they come; the same command goes on from it";
inline constexpr char shard[] = "only the I-th of N parts of the work, to be merged (equipoise merge)";
inline constexpr char csv[] = "one line per cell and outcome (.csv)";
inline constexpr char plot[] = "a picture: stacked shares along one parameter, a heat map over two";
}  // namespace sweep

}  // namespace equipoise::app::help
