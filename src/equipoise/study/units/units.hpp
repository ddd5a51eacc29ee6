// Values with units, such as "48 kN/m": what each quantity must measure.
// This room: physical units and texts with a unit.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "equipoise/machine/datasheet/scales.hpp"

namespace equipoise::study {

/// What a value measures. Speeds are of rotation; gain is torque per speed (also the drag of a ball).
enum class Dimension {
  mass,
  length,
  time,
  speed,
  velocity,
  acceleration,
  force,
  stiffness,
  damping,
  torque,
  gain,
  inertia,
  energy,
  power,
  unbalance,
  density,
  viscosity,
  kinematic_viscosity,
  angle,
  temperature,
  weight_inertia,  ///< GD^2 as a weight times a diameter squared
  tilt_damping,    ///< force for a speed of tilting
};

/// A dimension's name, unit and display.
struct DimensionWords {
  const char* name;     ///< with article: "a mass"
  const char* si;       ///< the internal unit: "kg"
  const char* example;  ///< "12 kg"
  const char* shown;    ///< the unit of an echo: "mm"
  /// The unit of numbers that have none: "R omega_c". Of what figures and columns measure.
  const char* dimensionless = "";
  double (*scale)(const model::Scales&) = nullptr;  ///< one dimensionless unit in `si`; null: no such study has it
};
const DimensionWords& words(Dimension dimension);
/// "a length of 0 or more, such as "0.2 mm"", of one of these; `bound`: " of 0 or more".
std::string wanted_text(const std::vector<Dimension>& wanted, const std::string& bound = "");

/// The unit in which results are shown, and the dimensionless unit in it: mm, N, mm/s, rpm of a study with scales.
struct ShownUnit {
  const char* name;
  double size;
};
ShownUnit shown_unit(Dimension dimension, const std::optional<model::Scales>& scales);

/// DimensionWords::scale; throws std::logic_error if there is none.
double scale_of(Dimension dimension, const model::Scales& scales);

/// A value in SI units, or what is wrong with its text.
struct Measured {
  double value = 0.0;
  Dimension dimension{};
  std::string problem;  ///< empty if the value is valid
};

/// A text's number and the rest of it. The number may be a fraction, "3/4 in" or "1 1/2 in", and begin with a plus
/// sign.
struct NumberAndUnit {
  double number = 0.0;
  std::string unit;  ///< without blanks around it
  std::errc error{};
};
NumberAndUnit split_quantity(std::string_view text);

/// The number of "5 %", a hundredth of what is written; empty for any other text.
std::optional<double> percentage(std::string_view text);

/// Reads "number unit" as a value of the first of `wanted` that the unit measures. Speeds: rad/s, rpm, Hz as turns per
/// second and 1/min or min-1 as turns a minute; a bare 1/s is refused. Temperatures: degC, degF and K, all to K. Any
/// finite number passes: callers check ranges.
Measured measure(const std::string& text, const std::vector<Dimension>& wanted);

/// The value in the dimension's display unit, with all its digits: "0.2 mm" from 0.0002 m.
std::string quantity_text(double si, Dimension dimension);

}  // namespace equipoise::study
