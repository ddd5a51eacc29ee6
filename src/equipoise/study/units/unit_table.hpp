// The units that studies may use, and products of them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

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

/// A text read as a product of units: names with a one-digit power at most, numbers, one level of brackets. A study
/// needs no more. Superscript digits, raised dots and typographic spaces are replaced: "N·m·s⁻²" becomes "N.m.s^-2".
struct UnitText {
  explicit UnitText(std::string_view given);

  std::string text;               ///< UTF-8, in plain signs
  bool is_product = false;        ///< it has the form of one
  std::string unknown;            ///< its first name that is not in the table
  int names = 0;                  ///< in it
  std::optional<TableUnit> unit;  ///< empty if it is not a product of units in the table
};

/// The unit alone.
inline std::optional<TableUnit> table_unit(std::string_view text) { return UnitText(text).unit; }

}  // namespace equipoise::study
