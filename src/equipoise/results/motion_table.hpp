// The numbers that are told of a motion: one line each, by which files and tables of branches and sweeps name them.
#pragma once

#include <array>
#include <limits>

#include "equipoise/results/branch.hpp"
#include "equipoise/types/motion.hpp"

namespace equipoise {

struct FigureName {
  const char* name;       ///< in files
  const char* long_name;  ///< with its unit
};
struct MotionFigure : FigureName {
  double (*value)(const Motion&);  ///< not-a-number where a motion has none
};
inline constexpr double no_figure = std::numeric_limits<double>::quiet_NaN();

inline constexpr std::array<MotionFigure, 6> motion_figures{{
    {{"period", "period of a periodic motion, in 1/omega_c"},
     [](const Motion& m) { return m.kind == MotionKind::periodic ? m.period : no_figure; }},
    {{"r_min", "smallest distance of the rotor's centre from the axis, in race radii"},
     [](const Motion& m) { return m.kind == MotionKind::measured ? no_figure : m.r_min; }},
    {{"r_mean", "mean distance of the rotor's centre from the axis, in race radii"},
     [](const Motion& m) { return m.kind == MotionKind::measured ? no_figure : m.r_mean; }},
    {{"r_max", "largest distance of the rotor's centre from the axis, in race radii"},
     [](const Motion& m) { return m.kind == MotionKind::measured ? no_figure : m.r_max; }},
    {{"multiplier", "largest modulus of a Floquet multiplier but the shift in time"}, largest_multiplier},
    {{"growth_rate", "growth rate of the slowest deviation, in omega_c; negative where it dies out"}, growth_rate},
}};
/// Of driven rotors.
inline constexpr std::array<MotionFigure, 5> motor_figures{{
    {{"speed", "mean speed of the rotor, in omega_c"}, [](const Motion& m) { return m.motor ? m.speed : no_figure; }},
    {{"speed_min", "smallest speed of the rotor, in omega_c"},
     [](const Motion& m) { return m.motor ? m.motor->speed_min : no_figure; }},
    {{"speed_max", "largest speed of the rotor, in omega_c"},
     [](const Motion& m) { return m.motor ? m.motor->speed_max : no_figure; }},
    {{"torque", "mean torque of the motor, in M R^2 omega_c^2"},
     [](const Motion& m) { return m.motor ? m.motor->torque : no_figure; }},
    {{"power", "mean power of the motor, in M R^2 omega_c^3"},
     [](const Motion& m) { return m.motor ? m.motor->power : no_figure; }},
}};

}  // namespace equipoise
