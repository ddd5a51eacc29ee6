// Usual units for builds without UDUNITS-2: the same names, bit-identical values.
#pragma once

#include <optional>
#include <string>

namespace equipoise::study {

/// A unit as a number of SI units.
struct TableUnit {
  double si = 1.0;
  int kilogram = 0, metre = 0, second = 0, radian = 0;  ///< powers

  bool same_kind(const TableUnit& other) const {  ///< angles count as pure numbers
    return kilogram == other.kilogram && metre == other.metre && second == other.second;
  }
};

/// Reads a name, or a product as defined by UnitText; empty if a name is not in the table.
std::optional<TableUnit> table_unit(const std::string& text);

}  // namespace equipoise::study
