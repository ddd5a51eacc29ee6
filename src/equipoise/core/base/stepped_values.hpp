// FROM:TO:STEP: values in equal steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/read_number.hpp"

namespace equipoise {

/// Rounded to twelve digits of the largest value, so that 1.4 + 20 * 0.05 is 2.4.
inline double to_twelve_digits(double value, double largest) {
  const double unit = std::pow(10.0, std::ceil(std::log10(std::max(largest, 1e-300))) - 12.0);
  return number_in(fmt::format("{:.12g}", std::round(value / unit) * unit));
}

/// Appends the values, at most `most`. Returns what is wrong with them, or an empty text.
inline std::string stepped_values(double from, double to, double step, std::size_t most, std::vector<double>& values) {
  if (step == 0.0 || (to - from) * step < 0.0)
    return fmt::format("STEP = {} does not lead from {} to {}; it must not be 0 and must have the sign of TO - FROM",
                       step, from, to);
  const double steps = std::floor((to - from) / step * (1.0 + 1e-12) + 1e-9);
  if (!(steps < static_cast<double>(most)))
    return fmt::format("has {:.6g} values; must have at most {}", steps + 1.0, most);
  const double largest = std::max(std::fabs(from), std::fabs(to));
  for (std::size_t k = 0; k <= static_cast<std::size_t>(steps); ++k)
    values.push_back(to_twelve_digits(from + static_cast<double>(k) * step, largest));
  return "";
}

}  // namespace equipoise
