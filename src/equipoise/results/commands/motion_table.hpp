// The numbers that are reported for a motion: one line each, from which files and tables of branches and sweeps are
// made.
#pragma once

#include <array>
#include <string_view>

#include "equipoise/results/columns/column.hpp"
#include "equipoise/results/commands/branch.hpp"
#include "equipoise/results/types/motion.hpp"

namespace equipoise {

struct MotionNumber : Column {
  double (*value)(const Motion&);  ///< not-a-number where a motion has none
};

inline constexpr std::array<MotionNumber, 6> motion_numbers{{
    {{"period", "period of a periodic motion", study::Dimension::time},
     [](const Motion& m) { return m.kind == MotionKind::periodic ? m.period : no_number; }},
    {{"r_min", "smallest distance of the rotor's centre from the axis", study::Dimension::length},
     [](const Motion& m) { return m.kind == MotionKind::measured ? no_number : m.r_min; }},
    {{"r_mean", "mean distance of the rotor's centre from the axis", study::Dimension::length},
     [](const Motion& m) { return m.kind == MotionKind::measured ? no_number : m.r_mean; }},
    {{"r_max", "largest distance of the rotor's centre from the axis", study::Dimension::length},
     [](const Motion& m) { return m.kind == MotionKind::measured ? no_number : m.r_max; }},
    {{"multiplier", "largest modulus of a Floquet multiplier but the shift in time"}, largest_multiplier},
    {{"growth_rate", "growth rate of the slowest deviation", study::Dimension::speed, "negative where it dies out"},
     growth_rate},
}};
constexpr const MotionNumber& motion_number(std::string_view name) {
  std::size_t k = 0;
  while (motion_numbers[k].name != name) ++k;
  return motion_numbers[k];
}

/// Of driven rotors.
inline constexpr std::array<MotionNumber, 5> motor_numbers{{
    {{"speed", "mean speed of the rotor", study::Dimension::speed},
     [](const Motion& m) { return m.motor ? m.speed : no_number; }},
    {{"speed_min", "smallest speed of the rotor", study::Dimension::speed},
     [](const Motion& m) { return m.motor ? m.motor->speed_min : no_number; }},
    {{"speed_max", "largest speed of the rotor", study::Dimension::speed},
     [](const Motion& m) { return m.motor ? m.motor->speed_max : no_number; }},
    // Torques have no dimensionless unit of their own (study::words), powers no dimension: their meanings name the
    // unit.
    {{"torque", "mean torque of the motor, in M R^2 omega_c^2"},
     [](const Motion& m) { return m.motor ? m.motor->torque : no_number; }},
    {{"power", "mean power of the motor, in M R^2 omega_c^3"},
     [](const Motion& m) { return m.motor ? m.motor->power : no_number; }},
}};

}  // namespace equipoise
