// Vibration severity of machines by classes and zones (ISO 10816-1:1995, Annex B): a figure to judge by, not a
// certification. ISO 20816-1:2016, which took its place, gives ranges for the same boundaries and no classes.
// This room: severity zones, hand-arm exposure, whether a machine slides on its feet.
#pragma once

#include <array>
#include <cmath>

#include "equipoise/core/base/standard_gravity.hpp"

namespace equipoise::standards {

/// Zones of root mean square velocity, measured on the housing over 10 to 1000 Hz.
enum class Zone {
  a,  ///< newly commissioned machines
  b,  ///< unrestricted long-term operation
  c,  ///< unsatisfactory for long-term operation
  d,  ///< severe enough to cause damage
};
inline constexpr std::array<const char*, 4> zone_names{"A", "B", "C", "D"};

struct SeverityClass {
  const char* name;
  std::array<double, 3> boundaries;  ///< A/B, B/C, C/D, mm/s
  const char* machines;              ///< what the standard gives as examples
};
inline constexpr std::array<SeverityClass, 4> severity_classes{{
    {"I", {0.71, 1.8, 4.5}, "small machines, electric motors up to 15 kW"},
    {"II", {1.12, 2.8, 7.1}, "electric motors of 15 to 75 kW, machines up to 300 kW on special foundations"},
    {"III", {1.8, 4.5, 11.2}, "large machines on rigid foundations"},
    {"IV", {2.8, 7.1, 18.0}, "large machines on soft foundations, such as turbo-generator sets"},
}};

/// Below this frequency a velocity says nothing: the standard's band begins here.
inline constexpr double lowest_severity_frequency = 10.0;  // Hz

/// The zone of a velocity in mm/s.
constexpr Zone zone_of(const SeverityClass& machine, double velocity) {
  int zone = 0;
  for (const double boundary : machine.boundaries) zone += velocity > boundary;
  return static_cast<Zone>(zone);
}

// Whether a machine on feet slides on its floor.

/// The largest rotating force (N) under which a machine of this mass (kg) cannot slide, with coefficient `friction`
/// between feet and floor, where the force turns in a vertical plane: it pushes sideways and lifts in turn, and F cos a
/// > friction (m g - F sin a) for some angle beyond friction m g/sqrt(1 + friction^2). A machine may twist on its feet
/// under less (E. Papadopoulos, I. Papadimitriou, Proc. IEEE/ASME AIM 2001, 899).
inline double sliding_force(double mass, double friction) {
  return friction * mass * standard_gravity / std::sqrt(1.0 + friction * friction);
}

}  // namespace equipoise::standards
