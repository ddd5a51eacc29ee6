// The answer of each computation in one sentence.
#pragma once

namespace equipoise::words::answers {

// Nothing is known.
inline constexpr char no_start_decided[] = "Nothing is known: stopped before any start was decided.";
inline constexpr char no_cell_done[] = "Nothing is known: no cell is done.";
inline constexpr char no_pixel_done[] = "Nothing is known: stopped before any pixel was done.";

// Many starts of one study. Starts, the share that may still balance, its bounds.
inline constexpr char none_balanced[] = "Not one of {} starts ends balanced: {}{} would (95 % confidence)";
// An outcome, its share, nothing or its bounds.
inline constexpr char ends_in[] = "The rotor ends {} in {} of starts (95 % confidence{})";
inline constexpr char surely[] = ", bounds {:.{}f} to {}";
inline constexpr char limit_in[] = "; {} in {}";
inline constexpr char no_balls[] =
    "There are no balls: the rotor's peak displacement is {}, and its RMS velocity at the end {}{}.";
inline constexpr char in_the_median[] = ", in the median";
inline constexpr char unknown_share[] = "an unknown share";
inline constexpr char less_than[] = "less than ";
inline constexpr char more_than[] = "more than ";
inline constexpr char never_up_to_speed[] = "; {} never come up to speed";
inline constexpr char stay_undecided[] = "; {} stay undecided";
inline constexpr char not_followed[] = "; {} could not be followed to an end";
inline constexpr char one_start[] = "1 start";
inline constexpr char some_starts[] = "{} starts";
// Quantities, nothing or " and ", the last quantity, the rest of the sentence.
inline constexpr char drawn_anew[] = "With {}{}{} drawn anew for every start, {}";
inline constexpr char and_last[] = " and ";

// Many cells. Cell or number of cells, what happens, its share.
inline constexpr char at[] = "at ";
inline constexpr char in_cells[] = "in {} of {} cells, such as {}";
inline constexpr char every_limit_kept[] = "every limit is kept";
inline constexpr char rotor_balanced[] = "the rotor ends balanced";
inline constexpr char one_cell[] = "At {} {} in {} of starts (95 % confidence)";
inline constexpr char cells_alike[] = "In each of {} cells {} in {} of starts (95 % confidence)";
// What happens, where most often, how often there, where least often, how often there.
inline constexpr char most_and_least_often[] =
    "{} most often {}: in {} of starts; least often {}: in {} (95 % confidence in each cell)";
inline constexpr char every_limit_kept_first[] = "Every limit is kept";
inline constexpr char rotor_balanced_first[] = "The rotor ends balanced";
inline constexpr char from_to[] = "{:.3g} to {:.3g} %";
inline constexpr char undecided_up_to[] = "; up to {} stay undecided, at {}";

// Capacity, the largest value of a quantity. Quantity, value, starts, what is asked of them.
inline constexpr char surely_between[] = "{} (between {:.4g} and {:.4g})";
inline constexpr char nowhere[] = "At {} {}, where the range begins, fewer than {} {}: {}";
inline constexpr char up_to_the_end[] = "Up to {} {}, the end of the range, {} {}: {}";
inline constexpr char up_to[] = "Up to {} {}, {} {}: {}";
inline constexpr char fewer_from_value[] = "From {} {} on, fewer than {} {}: {}";
inline constexpr char stopped_before_found[] = "; stopped before the largest was found.";
inline constexpr char no_cell_finished[] = "No cell is finished; the table shows what is known of each.";
// How sure that is.
inline constexpr char shown_up_to[] = "shown up to {:.4g}";
inline constexpr char fewer_from[] = "shown to be fewer from {:.4g} on";
inline constexpr char likely[] = "likely ";
inline constexpr char not_shown[] = "likely, but not shown";
inline constexpr char share_of_starts[] = "{:.4g} % of starts";
inline constexpr char confidence[] = " (95 % confidence)";
inline constexpr char at_cell[] = ", at ";
inline constexpr char largest_in_all_cells[] =
    "The largest {} at which {} {} is {} in each of {} cells (95 % confidence).";
inline constexpr char largest_at[] =
    "The largest {} at which {} {} is {} at {}; it is least at {}: {} (95 % confidence).";

// Points of a map.
inline constexpr char points_of_plane[] = "{} points over {} and {}";
inline constexpr char none_of_points[] = "Not one of {} ends balanced";
inline constexpr char of_points[] = "Of {}, {} end {} (95 % confidence, as of random ones)";
inline constexpr char radius_of_balance[] = "; all within {:.3g} rad of balanced angles do";

// Initial values.
inline constexpr char initial_rate[] = "initial rate of ball ";
inline constexpr char initial_angle[] = "initial angle of ball ";

}  // namespace equipoise::words::answers
