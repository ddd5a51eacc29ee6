// Sentences and words that more than one file of this chapter, or of those below it, prints.
#pragma once

#include <array>
#include <utility>

namespace equipoise::words::design {

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

// The study's own settings.
inline constexpr char as_given[] = "as it is";

}  // namespace equipoise::words::design

namespace equipoise::words::sweeps {

// Axes and pixels of a map.
inline constexpr char same_key_twice[] = "both axes vary the same key; must be two";
// The other axis.
inline constexpr char set_by_other_axis[] = "varies nothing: {}, the other axis, sets the same quantity";

}  // namespace equipoise::words::sweeps
