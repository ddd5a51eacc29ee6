// What of a unit's text reaches the parser of UDUNITS.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace equipoise::study {

/// A product of units: names with a one-digit power at most, numbers, one level of brackets. That is all a study needs,
/// and nothing else reaches UDUNITS, which knows dates, offsets and logarithms as well and loses memory over what it
/// cannot read. Raised digits, raised dots and typographic spaces count as what they stand for: "N·m·s⁻²" is
/// "N.m.s^-2".
struct UnitText {
  explicit UnitText(std::string_view given);

  std::string text;                ///< UTF-8, for UDUNITS
  std::vector<std::string> names;  ///< of the units in it
  bool is_product = false;
};

}  // namespace equipoise::study
