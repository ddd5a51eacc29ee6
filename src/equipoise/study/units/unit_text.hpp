// The texts of units.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace equipoise::study {

/// A product of units: names with a one-digit power at most, numbers, one level of brackets. A study needs no more.
/// Superscript digits, raised dots and typographic spaces are replaced: "N·m·s⁻²" becomes "N.m.s^-2".
struct UnitText {
  explicit UnitText(std::string_view given);

  std::string text;                ///< UTF-8, in plain signs
  std::vector<std::string> names;  ///< of the units in it
  bool is_product = false;
};

}  // namespace equipoise::study
