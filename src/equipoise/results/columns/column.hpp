// How a column of numbers is described: one line each, over which files, tables, pages and Python go.
// This room: columns of numbers: name, meaning, unit, getter, one line each.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "equipoise/study/units/units.hpp"

namespace equipoise {

inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();  ///< for a number that is missing

struct Column {
  const char* name;                                          ///< in files, JSON and arrays
  const char* meaning;                                       ///< without its unit
  std::optional<study::Dimension> dimension = std::nullopt;  ///< none: a pure number
  const char* remark = "";                                   ///< behind the unit: "missing: not settled"

  const char* unit() const { return dimension ? study::words(*dimension).dimensionless : "1"; }
  /// As in CF, which knows nothing of R and omega_c: long_name() names those.
  const char* cf_units() const { return dimension == study::Dimension::angle ? "radian" : "1"; }
  /// "study time at which the outcome was known, in 1/omega_c".
  std::string long_name() const {
    std::string text = meaning;
    if (dimension == study::Dimension::length)
      text += ", in race radii";
    else if (dimension && dimension != study::Dimension::angle)
      text += std::string(", in ") + unit();
    return text + (*remark ? "; " : "") + remark;
  }
};

/// Its title in CSV. In a study with physical units its unit follows: "t (1/omega_c)".
inline std::string csv_title(const Column& column, const std::optional<model::Scales>& scales) {
  return scales && column.dimension ? std::string(column.name) + " (" + column.unit() + ")" : column.name;
}

}  // namespace equipoise
