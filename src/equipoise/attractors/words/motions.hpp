// Names of motions. Files of results keep them, and analyses/basin_slices/slice_names.cpp knows some: a new name is a
// new motion there.
// This room: the sentences of this chapter.
#pragma once

namespace equipoise::words::motions {

// One ball, or the whole balancer.
inline constexpr char balanced[] = "balanced";
inline constexpr char balanced_stuck[] = "balanced, stuck";
inline constexpr char locked[] = "locked";
inline constexpr char locked_stuck[] = "locked, stuck";
inline constexpr char hanging[] = "hanging";
inline constexpr char captured[] = "captured";
inline constexpr char drifting[] = "drifting";

// Two balls or more.
inline constexpr char both_captured[] = "both captured";
inline constexpr char one_captured[] = "one captured";
inline constexpr char all_captured[] = "all captured";
// Captured balls, those together, drifting balls, those together, how it repeats.
inline constexpr char some_captured[] = "{} captured{}, {} drifting{}{}";
inline constexpr char different_rates[] = "drifting at different rates";
inline constexpr char co_drifting[] = "co-drifting";
inline constexpr char pair_drift[] = "pair drift";
inline constexpr char drifting_apart[] = "drifting apart";

// What follows a name: how the motion repeats, which balls are together, how the rotor turns.

// Strobes, the plural s.
inline constexpr char back_after[] = ", back after {} strobe{}";
inline constexpr char period[] = ", period {}";
inline constexpr char all_together[] = " together";
inline constexpr char some_together[] = " ({} together)";
inline constexpr char at_resonance[] = ", captured at resonance";
inline constexpr char backwards[] = ", backwards";

}  // namespace equipoise::words::motions
