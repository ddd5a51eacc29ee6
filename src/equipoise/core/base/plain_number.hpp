// Numbers for sentences: few digits and no exponents.
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace equipoise {

/// `digits` significant digits, but never fewer than stand before the point.
inline std::string plain_number(double value, int digits) {
  return std::fabs(value) < std::pow(10.0, digits) ? fmt::format("{:.{}g}", value, digits)
                                                   : fmt::format("{:.0f}", value);
}

}  // namespace equipoise
