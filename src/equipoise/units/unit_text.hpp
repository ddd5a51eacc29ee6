// The texts of units that may reach the parser of UDUNITS.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace equipoise::study {

/// A product of units: names with a one-digit power at most, numbers, one level of brackets. A study needs no more.
/// UDUNITS also knows dates, offsets and logarithms, and leaks memory on text that it cannot read; none of that reaches
/// it. Superscript digits, raised dots and typographic spaces are replaced: "N·m·s⁻²" becomes "N.m.s^-2". So are names
/// that workshops use and UDUNITS does not know or takes for a volume: oz (of mass), ozf, lbs, rev, kp, cP.
struct UnitText {
  explicit UnitText(std::string_view given);

  std::string text;                ///< UTF-8, for UDUNITS
  std::vector<std::string> names;  ///< of the units in it
  bool is_product = false;
};

}  // namespace equipoise::study
