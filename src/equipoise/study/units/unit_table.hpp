// The units that studies may use.
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
  /// One of this unit in the other; 0 if that measures something else.
  double worth_in(const TableUnit& other) const;
  /// Whether it contains radians to the first power: speeds of rotation do, frequencies do not.
  bool counts_radians() const { return radian == 1; }
};

/// Reads a name, or a product as defined by UnitText; empty if a name is not in the table.
std::optional<TableUnit> table_unit(const std::string& text);

}  // namespace equipoise::study
