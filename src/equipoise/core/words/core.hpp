// Values and files that cannot be read, and threads that cannot run.
// This room: the sentences of this chapter.
#pragma once

namespace equipoise::words::core {

inline constexpr char step_leads_away[] =
    "STEP = {} does not lead from {} to {}; it must not be 0 and must have the sign of TO - FROM";
inline constexpr char too_many_values[] = "has {:.6g} values; must have at most {}";
inline constexpr char not_a_time[] =
    "must be a time greater than 0, at most 10000 h, in seconds or with a unit: 90, 60s, 10min, 1.5h";
// Threads, those that could be made, the system's words.
inline constexpr char no_thread[] = "{} threads cannot run: the system makes only {} ({}); use fewer";
inline constexpr char no_memory_for_threads[] =
    "{} threads cannot run: the process is not allowed as much memory; use fewer";
inline constexpr char directory[] = "a directory";
inline constexpr char no_permission[] = "not open to this user";
inline constexpr char no_file[] = "no such file";
inline constexpr char file_too_long[] = "more than {} MiB";
inline constexpr char reading_broke_off[] = "reading broke off";

}  // namespace equipoise::words::core
