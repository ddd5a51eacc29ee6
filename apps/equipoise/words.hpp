// What the program says besides results: errors about options, files and processes; notes; progress.
#pragma once

namespace equipoise::app::words {

// Commands and options that were not understood.

// The list of commands, as below.
inline constexpr char no_command[] = "a command is missing; {} (equipoise --help says more)";
// Command, a guess or nothing, the list of commands.
inline constexpr char unknown_command[] = "unknown command \"{}\"{}; {}";
// "basin: " or nothing, option, a guess or nothing, command whose help lists the options.
inline constexpr char unknown_option[] = "{}unknown option \"{}\"{}; {} --help lists all";
inline constexpr char meant[] = " (is \"{}\" meant?)";
inline constexpr char one_of[] = "must be one of: {}";
inline constexpr char unexpected[] = "{}unexpected \"{}\"; one study is enough, and options begin with --";
// Command, option, times, values.
inline constexpr char given_twice[] = "{}: {}: given {} times ({}); must be given once";
// Command, option, what it takes.
inline constexpr char value_missing[] = "{}: {}: its value is missing; it takes {}";
// Command, argument, its help.
inline constexpr char argument_missing[] = "{}: {} is missing; expected {}";
inline constexpr char value_empty[] = "is empty; it takes {}";

// Values of options. After the option and its value.

// One of the ranges below.
inline constexpr char must_be[] = "must be {}";
inline constexpr char must_be_time[] = "must be {}, in 1/omega_c, or a time, such as \"10 s\"";
inline constexpr char no_units[] = "must be {}: this study has no units";
inline constexpr char thread_range[] = "a whole number from 1 to 4096";
inline constexpr char start_range[] = "a whole number from 1 to 1000000000000";
inline constexpr char seed_range[] = "a whole number from 0 to 9223372036854775807";
inline constexpr char index_range[] = "a whole number from 0 to 999999999999";
inline constexpr char half_width_range[] = "a fraction of one from 1e-6 to 0.5";
inline constexpr char row_range[] = "a whole number from 2 to 1000000";
inline constexpr char state_form[] = "{} numbers separated by commas: x,y,u,v, ball angles, ball rates";
inline constexpr char share_range[] = "a fraction of one from 0.01 to 0.9999";
inline constexpr char precision_range[] = "a part of the range from 0.0001 to 0.1";
inline constexpr char trajectory_range[] = "a whole number from 1000 to 1000000000000";
inline constexpr char axis_form[] = "must be KEY=LOW:HIGH, e.g. speed.final=0.5:6";
// Option, key, a range.
inline constexpr char axis_without_range[] = "has no range; must be LOW:HIGH, e.g. {0} {1}={2} or {0}-range {2}";
inline constexpr char range_given_twice[] = "{} has a range, too; give one";
inline constexpr char box_range[] = "a whole number from 0 to 1000000000";
inline constexpr char undecided_range[] = "must be a part of the plane in percent, more than 0 and less than 100";
inline constexpr char pixel_range[] = "a whole number from 2 to 4096";
inline constexpr char paper_start_range[] = "a whole number from 1 to 1000000000";
inline constexpr char time_range[] = "a number from 0 to 1e9";
inline constexpr char step_range[] = "a number greater than 0, at most 1e9";
inline constexpr char lines_apart_range[] = "a number of seconds from 0.1 to 86400";
inline constexpr char tolerance_range[] = "a number from 1e-14 to 1e-2";
inline constexpr char times_out_of_order[] = "times out of order: must be later than {}";
inline constexpr char shard_form[] = "must be I/N with I from 1 to N, e.g. 2/8";

// Files. After the option and its path.

// Why.
inline constexpr char same_file[] = "is the same file as {}; must be another one";
inline constexpr char not_writable[] = "cannot be written: {}; must be a file in a folder that exists";
inline constexpr char ends_in[] = "must be a file name that ends in {}";
inline constexpr char ends_in_either[] = "must be a file name that ends in {} or {}";
inline constexpr char ends_in_csv_or_nc[] = "must be a file name ending in .csv or .nc";
inline constexpr char not_a_folder[] = "must be a folder that can be written";
inline constexpr char not_a_certificate[] = "cannot be read ({}); must be a file written by equipoise certify -o";
inline constexpr char study_exists[] = "exists; must be a new file: no study is overwritten";
inline constexpr char output_not_writable[] = "standard output cannot be written: {}";
inline constexpr char out_of_memory[] = "out of memory: the system gives no more to this process";
inline constexpr char no_more_threads[] = "the system makes no more threads for this process";

// Options that do not go together.
inline constexpr char along_only[] = "goes with --along KEY=FROM:TO:STEP only";
inline constexpr char cost_only[] = "goes with --cost only: nothing else takes time here";
inline constexpr char report_only[] = "goes with --report";
inline constexpr char page_of_an_ensemble[] =
    "a page reports an ensemble, not one start; must be left out with --start-index";
inline constexpr char study_or_certificate[] = "give either a study or --check with a certificate's file";
inline constexpr char checked_as_it_is[] = "a certificate is checked as it is: --set and -o need a study";
inline constexpr char result_is_done[] = "go with studies; a result is already computed";
inline constexpr char at_or_every[] = "give either --at or --every and --until, not both";
inline constexpr char nothing_varied[] =
    "says nothing, and the study has no [sweep] with over = [\"KEY=VALUES\"]; must name a parameter and its values, "
    "e.g. speed.final=1.5:6:0.1";
// Shard, cells, blocks, "s" or nothing, cells of a block at most, one of the next two.
inline constexpr char empty_shard[] =
    "shard {} is empty: the {} cells form {} block{} of up to {} cells, and a shard computes whole blocks; {} all\n";
inline constexpr char first_shard_has[] = "shard 1 has", first_shards_have[] = "the first {} shards have";
inline constexpr char shard_needs_output[] = "needs -o: the file that is merged with those of the other shards";

// Jobs of several processes. After the variable that says so.
inline constexpr char different_shards[] =
    "is not what the other processes of the job were given; must be the same for all, which share the work of that "
    "part (start processes that have a part each without mpirun)";
inline constexpr char shares_no_work[] =
    "says that {} processes were started, but \"{}\" shares no work: each would do the whole work. Start one process, "
    "which uses all cores";
// Processes, the line below or nothing.
inline constexpr char built_without_mpi[] =
    "says that {} processes were started, but this program is built without MPI: each would do the whole work. Install "
    "an MPI library (Debian: apt-get install libopenmpi-dev) and build again (./dev run, or cmake), or {}start one "
    "process";
inline constexpr char or_a_part_each[] = "give each process a part with --shard I/N, or ";
inline constexpr char message_cut_short[] = "a message between processes was cut short";
inline constexpr char mpi_not_built_in[] = "not built in";

// Notes.

inline constexpr char drawn_all_round[] = " (a quarter turn: it is drawn all round)";
inline constexpr char at_medians[] = "samples nothing; uncertain values are at their medians: {}";
inline constexpr char nothing_proved[] = "nothing is proved, so {} is not written";
inline constexpr char map_read[] = "read from {}";
// File, machine, file.
inline constexpr char study_written[] =
    "{} is a study of a {} to start from; equipoise check {} says what is understood";
inline constexpr char published_law[] = "published speed law, psi = t Omega(t)";
inline constexpr char simulation_stopped[] = "stopped after t = {}; the rows so far are kept";
inline constexpr char diverged[] = "the trajectory diverged after t = {}; the rows so far are kept";
inline constexpr char not_integrated[] =
    "the trajectory could not be integrated further after t = {}; the rows so far are kept";

// A run that ended early: how far it came, how it goes on.
inline constexpr char stopped[] = "stopped; {}";
// The time given, how far it came, how it goes on.
inline constexpr char time_over[] = "out of time (--within {}): {}; {}";
inline constexpr char rest_unknown[] = "how long the rest takes is not known yet";
// Stage, rest.
inline constexpr char was_at[] = "it was at \"{}\"; {}";
// Number, total, what is counted.
inline constexpr char part_done[] = "{} of {} {} are done";
inline constexpr char rest_takes[] = "{}; the rest takes about {} more";
inline constexpr char goes_on_from[] = "the same command goes on from {}";
inline constexpr char nothing_yet[] = "nothing is in {} yet";
inline constexpr char would_go_on[] = "with {} the same command would go on from here";
inline constexpr char keeps_nothing[] = "this command keeps nothing between runs: give it more time";

// What is counted there.
inline constexpr char trials[] = "trials (at most)";
inline constexpr char starts_of_both[] = "starts of both";
inline constexpr char starts[] = "starts";
inline constexpr char trajectories[] = "trajectories";
inline constexpr char rows[] = "rows";

// Progress.

// Percent, number, total.
inline constexpr char fraction_done[] = "{:3.0f} %  {} of {}";
inline constexpr char rate_and_rest[] = "  {:.0f}/s  {} left";
inline constexpr char stage_and_rate[] = "{}  {}  {:.0f}/s";
// Number, what is counted, rate.
inline constexpr char number_and_rate[] = "{} {}  {:.0f}/s";
inline constexpr char balanced_so_far[] = "  balanced {:.2f} %";
// Cell, starts, share, its interval, share of undecided starts.
inline constexpr char cell_done[] = "{}: {} starts, balanced {} ({}), undecided {}\n";

// What equipoise --version says: version, compiler, instruction sets, the one in use, optimisers, MPI.
inline constexpr char version[] =
    "equipoise {}\ncompiler: {}\nCPU targets here: {}; using {}\noptimisers: {}\nMPI: {}\n";

}  // namespace equipoise::app::words
