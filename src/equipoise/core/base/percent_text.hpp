// A share as a percentage with two digits.
#pragma once

#include <string>

#include <fmt/format.h>

namespace equipoise {

/// "0.15 %", "3.2 %", "47 %"; "more than 99 %" or "less than 0.01 %" where rounding would give all or none.
inline std::string percent_text(double share) {
  const double percent = 100.0 * share;
  if (percent > 99.0 && share < 1.0) return "more than 99 %";
  if (percent < 0.01 && share > 0.0) return "less than 0.01 %";
  return fmt::format("{:.{}f} %", percent, percent >= 10.0 || share <= 0.0 ? 0 : percent >= 1.0 ? 1 : 2);
}

}  // namespace equipoise
