// Other groups' publications, their numbers computed again.
#pragma once

namespace equipoise::words::publications {

inline constexpr char lost_on_the_way[] = "a trajectory of this publication's study could not be followed";
inline constexpr char no_balance[] = "the balls of this publication's study cannot balance it";
inline constexpr char unknown[] = "must be one of {}; separate several by commas";

// Heading of the list: what can be named.
inline constexpr char list_heading[] =
    "Wright and Peng 2019, the paper of this model; all of it if nothing is named:\n{}\n"
    "Other publications; `publications` is all of them:\n";
inline constexpr char list_line[] = "  {:<16}{}\n  {:<16}{} of {} numbers can be computed here\n";

// Title of the page, and how to read it.
inline constexpr char page_title[] = "Other publications, computed again";
inline constexpr char page_note[] =
    "A number agrees if it lies as near to the publication's as both errors together allow. A published error is "
    "half a unit of the last digit; of a plot that was read, 2 % of the axis of a time history, 0.01 in the speed "
    "and 0.02 decades of a chart; nothing where a formula gives the number. Where it is not on record how well a "
    "plot can be read, the error is assumed: half a unit of the last digit that was read, 0.02 for speeds in "
    "run-ups, 2.5 rpm for simulated critical speeds. An error here is what the computation leaves open: a sample's "
    "95 % interval, the spread of irregular motions, steps of a search.";
// Agree, all judged, differ, of them explained, not computed.
inline constexpr char tally[] = "{} of {} numbers agree, {} differ{}; {} not computed.";
inline constexpr char some_explained[] = ", {} of them for a reason that is known";
inline constexpr char all_explained[] = ", each for a reason that is known";
// Numbers left, all.
inline constexpr char partial[] = " PARTIAL: stopped early; {} of {} numbers were not reached.";
inline constexpr char seen[] = "Read: {}";
inline constexpr char made_by[] = "Made by `{}`.";
inline constexpr char study_file[] = "Study: {}";

}  // namespace equipoise::words::publications
