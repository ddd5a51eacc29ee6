// Levels of figures that standards set, beside a study's limits: how many starts exceed each is counted.
#pragma once

#include <array>
#include <optional>

#include "equipoise/results/columns/transient_figures.hpp"

namespace equipoise {

struct StandardLevel {
  const char* name;                              ///< in JSON and files
  float TransientRow::*value;                    ///< the figure
  bool at_end;                                   ///< else it is a peak, which stays exceeded
  std::optional<double> (*level)(const Study&);  ///< dimensionless; empty where the study does not ask
};

/// Zone boundaries A/B, B/C, C/D of the study's class, for the velocity in one direction; empty for a rotor that
/// turns too slowly for the standard's band of frequencies.
std::optional<double> zone_boundary(const Study& study, int boundary);
/// The peak force on the supports, the weight that hangs in them included, from which on a machine on feet may slide.
std::optional<double> sliding_level(const Study& study);

inline constexpr std::array<StandardLevel, 4> standard_levels{{
    {"zone_a", &TransientRow::rms_velocity_one_direction, true, [](const Study& s) { return zone_boundary(s, 0); }},
    {"zone_b", &TransientRow::rms_velocity_one_direction, true, [](const Study& s) { return zone_boundary(s, 1); }},
    {"zone_c", &TransientRow::rms_velocity_one_direction, true, [](const Study& s) { return zone_boundary(s, 2); }},
    {"standing_still", &TransientRow::peak_force, false, sliding_level},
}};

}  // namespace equipoise
