// The titles of columns in CSV.
#pragma once

#include <string>

#include "equipoise/results/columns/column.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The name of a column. In a study with physical units its unit follows: "t (1/omega_c)".
inline std::string csv_title(const Column& column, const Study& study) {
  return study.scales && column.dimension ? std::string(column.name) + " (" + column.unit() + ")" : column.name;
}

}  // namespace equipoise
