// Values with units, such as "48 kN/m". A library reads the units; this file says what each quantity must measure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "equipoise/model/scales.hpp"

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
};

/// A dimension's name, unit and display.
struct DimensionWords {
  const char* name;     ///< with article: "a mass"
  const char* si;       ///< the internal unit: "kg"
  const char* example;  ///< "12 kg"
  const char* shown;    ///< the unit of an echo: "mm"
  /// The unit of numbers that have none: "R omega_c". Of what figures and columns measure.
  const char* dimensionless = "";
};
const DimensionWords& words(Dimension dimension);

/// The unit in which results are shown, and the dimensionless unit in it: mm, N, mm/s, rpm of a study with scales.
struct ShownUnit {
  const char* name;
  double size;
};
ShownUnit shown_unit(Dimension dimension, const std::optional<model::Scales>& scales);

/// What one dimensionless unit of the dimension is worth in its SI unit. Of those that a dimensionless study has; all
/// others throw std::logic_error.
double scale_of(Dimension dimension, const model::Scales& scales);

/// A value in SI units, or what is wrong with its text.
struct Measured {
  double value = 0.0;
  Dimension dimension{};
  std::string problem;  ///< empty if the value is valid
};

/// Reads "number unit" as a value of the first of `wanted` that the unit measures. Speeds: rad/s, rpm, and Hz as turns
/// per second (UDUNITS would read 1 rad/s); a bare 1/s is refused. Any finite number passes: callers check ranges.
/// Throws RunError if the library of units cannot be used.
Measured measure(const std::string& text, const std::vector<Dimension>& wanted);

/// The value in the dimension's display unit, with all its digits: "0.2 mm" from 0.0002 m.
std::string quantity_text(double si, Dimension dimension);

}  // namespace equipoise::study
