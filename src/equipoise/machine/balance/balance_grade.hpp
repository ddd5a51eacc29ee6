// Balance quality grades of rigid rotors (ISO 21940-11:2016): a figure to compare machines by, not a certification.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "equipoise/core/base/typed_numbers.hpp"

namespace equipoise::model {

/// The standard's grades G in mm/s, each about 2.5 times the one before.
inline constexpr std::array<double, 11> standard_balance_grades{0.4,   1.0,   2.5,   6.3,    16.0,  40.0,
                                                                100.0, 250.0, 630.0, 1600.0, 4000.0};

/// Speed in mm/s of the centre of mass round the shaft, for a residual eccentricity `eccentricity_m` (m, >= 0) at
/// `speed_rad_s` (either sense of rotation).
inline double balance_grade(double eccentricity_m, double speed_rad_s) {
  return 1000.0 * eccentricity_m * std::abs(speed_rad_s);
}

/// The best standard grade that `grade_mm_s` does not exceed; empty above G 4000.
inline std::optional<double> standard_grade_met(double grade_mm_s) {
  for (const double g : standard_balance_grades)
    if (at_most(grade_mm_s, g)) return g;
  return std::nullopt;
}

}  // namespace equipoise::model
