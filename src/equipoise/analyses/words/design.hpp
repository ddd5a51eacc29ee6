// Designs: what was chosen, how far it may be off, what is missing.
// This room: the sentences of this chapter.
#pragma once

#include <array>
#include <utility>

namespace equipoise::words::design {

// The answer. Objectives with their values follow.
inline constexpr char all_kept[] = "All requirements are kept: ";
inline constexpr char stopped_before_a_candidate[] = "PARTIAL: stopped before any candidate was known.";
inline constexpr char no_candidate[] = "No candidate was found.";
// Nothing or the figure's name, its value.
inline constexpr char as_it_is[] = "; as it is {}{}";
// "; " or nothing, figure, limit, how sure, value.
inline constexpr char must_be[] = "{}{} must be {} and is {}{}";
inline constexpr char not_surely_but_likely[] = "likely, but not shown: ";
inline constexpr char at_best[] = "at best ";
inline constexpr char not_all_kept[] = "No candidate keeps all requirements: {}. The nearest has {}{}.";

// Limits and estimates.
inline constexpr char of_starts_below[] = " of starts below";
inline constexpr char below[] = "below ";
inline constexpr char above[] = "above ";
inline constexpr char and_above[] = " and above ";
inline constexpr char not_stated[] = "not stated";
inline constexpr char no_end[] = "no end";
inline constexpr char with_interval[] = "{} ({:.3g} to {})";
inline constexpr char speed_at_time[] = "{}{} at {}";

// The verdict. "PARTIAL: " or nothing stands first.
inline constexpr char none_followed[] = "No candidate was followed to its end.";
inline constexpr char not_known[] = "Not known. A longer --within, or fewer values to choose from, may tell more.";
inline constexpr char leave_as_it_is[] = "{}Leave it as it is: {}nothing found is shown to be better.{}";
inline constexpr char best_found[] = " Best found: {}.";
inline constexpr char nothing_to_choose[] = "There is nothing to choose.";
inline constexpr char keeps_all_and[] = "it keeps all requirements, and ";
inline constexpr char all_are_kept[] = ": all requirements are kept";
inline constexpr char nearest[] = "{}Nothing tried is shown to keep all requirements; nearest: {}.";
inline constexpr char margins_unknown[] = "How far each number may be off was not worked out: time ran out.";
inline constexpr char states_no_number[] = "The study states none of these numbers, so that none was changed alone.";
inline constexpr char nothing_misses[] = "Each number was changed alone: no value tried fails what the design keeps.";
inline constexpr char surely_no_worse[] = ": shown to be no worse.";
inline constexpr char requirements_kept[] = ": requirements kept.";

// How far one number may be off: value and unit.
inline constexpr char others_below[] = "; and others below";
inline constexpr char only[] = "{}{} only";
inline constexpr char or_more[] = "{}{} or more";
inline constexpr char or_less[] = "{}{} or less";
inline constexpr char from_to[] = "{} to {}{}";

// Things that are chosen, and their values after them.
struct Thing {
  const char* key;
  const char* name;    // "ball diameter"
  const char* before;  // its value follows: "balls let go at "
};
inline constexpr std::array<Thing, 12> things{{{"balancer.balls", "number of balls", ""},
                                               {"balancer.ball_diameter", "ball diameter", ""},
                                               {"balancer.mass", "mass of a ball", ""},
                                               {"balancer.oil.grade", "oil", ""},
                                               {"balancer.oil_viscosity", "oil's viscosity", "oil of "},
                                               {"balancer.drag", "drag", "drag "},
                                               {"balancer.race_radius", "race radius", "race radius "},
                                               {"rotor.damping_ratio", "damping ratio", "damping ratio "},
                                               {"rotor.stiffness", "stiffness", "stiffness "},
                                               {"release.speed", "speed of release", "balls let go at "},
                                               {"release.time", "time of release", "balls let go after "},
                                               {"speed", "run-up", "run-up "}}};

// Shares and times of the starts; quantiles are named by transient_figures.
inline constexpr std::array<std::pair<const char*, const char*>, 7> figures{{
    {"balanced", "starts that balance"},
    {"passed", "starts that pass resonance"},
    {"limits_kept", "starts within all limits"},
    {"limits_kept_at_end", "starts within all limits at the end"},
    {"limits_kept_on_the_way", "starts never over a limit on the way"},
    {"undecided", "undecided starts"},
    {"time_to_balance", "time to balance"},
}};

// Things without a name of their own.
inline constexpr char as_mass[] = " (mass)";
inline constexpr char of_size[] = " of ";
inline constexpr char time_of_point[] = "time of point ";
inline constexpr char speed_of_point[] = "speed of point ";

// How near a design is to its limits. Figure, value, unit, "below" or "above", limit, unit.
inline constexpr char is_and_must_be[] = "{} is {:.4g}{}, must be {} {:.4g}{}";
inline constexpr char not_met[] = "not met: ";
inline constexpr char not_surely_met[] = "not shown to be met: ";
inline constexpr char nearly_reached[] = "nearly reached: ";
// Key, "lower" or "upper", prefix, value, unit.
inline constexpr char at_end_of_range[] = "{} is at the {} end of its range: {}{:.4g}{}";
inline constexpr char no_balance_attracts[] = "no balanced state attracts";

// Within the program.
inline constexpr char search_is_over[] = "the search is over";
// The study's own settings.
inline constexpr char as_given[] = "as it is";

}  // namespace equipoise::words::design
