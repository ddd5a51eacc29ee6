// Quantities in the units that engineers use.
#pragma once

#include <optional>
#include <string>

#include "equipoise/study/units/units.hpp"

namespace equipoise {

/// A unit as written, and its value in SI units.
struct EngineeringUnit {
  const char* name;
  double si;
};

/// The largest unit in which `si` is at least 1; speeds of rotation in rpm.
EngineeringUnit engineering_unit(double si, study::Dimension dimension);

/// "0.2 mm": five digits, in that unit.
std::string engineering(double si, study::Dimension dimension);
/// The same of a study's own number; without scales its five digits alone.
std::string engineering(const std::optional<model::Scales>& scales, double value, study::Dimension dimension);

}  // namespace equipoise
