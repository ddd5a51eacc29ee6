// Quantities in the units that engineers read them in.
#pragma once

#include <string>

#include "equipoise/units/units.hpp"

namespace equipoise {

/// A unit as it is written, and what one of it is worth in SI units.
struct EngineeringUnit {
  const char* name;
  double si;
};

/// The largest unit that leaves at least one whole of `si`; speeds of rotation in rpm.
EngineeringUnit engineering_unit(double si, study::Dimension dimension);

/// "0.2 mm": five digits, in that unit.
std::string engineering(double si, study::Dimension dimension);

}  // namespace equipoise
