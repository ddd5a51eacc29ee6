// Quantities in the units that engineers read them in.
#pragma once

#include <string>

#include "equipoise/study/units.hpp"

namespace equipoise {

/// "0.2 mm": five digits, in the largest unit that leaves at least one whole; speeds of rotation in rpm.
std::string engineering(double si, study::Dimension dimension);

}  // namespace equipoise
