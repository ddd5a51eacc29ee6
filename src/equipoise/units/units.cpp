// The dimension of each quantity, and conversion of its numbers.
#include "equipoise/units/units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/base/display_text.hpp"
#include "equipoise/base/read_number.hpp"
#include "equipoise/units/unit_library.hpp"
#include "equipoise/units/unit_text.hpp"

namespace equipoise::study {

namespace {

constexpr std::array<DimensionWords, 19> all_words{{
    {"a mass", "kg", "12 kg", "kg"},
    {"a length", "m", "0.2 mm", "mm", "R"},
    {"a time", "s", "10 s", "s", "1/omega_c"},
    {"a speed of rotation", "rad/s", "3000 rpm", "rpm", "omega_c"},
    {"a velocity", "m/s", "4.5 mm/s", "mm/s", "R omega_c"},
    {"an acceleration", "m/s2", "9.81 m/s2", "m/s2"},
    {"a force", "N", "500 N", "N", "M R omega_c^2"},
    {"a stiffness", "N/m", "48 kN/m", "N/m"},
    {"a damping coefficient", "N s/m", "200 N s/m", "N s/m"},
    {"a torque", "N m", "0.5 N m", "N m"},
    {"a torque for a speed of rotation", "N m s", "0.01 N m s", "N m s"},
    {"a moment of inertia", "kg m2", "0.02 kg m2", "kg m2"},
    {"an energy", "J", "20 J", "J", "M R^2 omega_c^2"},
    {"a power", "W", "1.5 kW", "W", "M R^2 omega_c^3"},
    {"an unbalance", "kg m", "300 g mm", "g mm", "M R"},
    {"a density", "kg/m3", "7800 kg/m3", "kg/m3"},
    {"a viscosity", "Pa s", "100 mPa s", "mPa s"},
    {"a kinematic viscosity", "m2/s", "100 cSt", "cSt"},
    {"an angle", "rad", "30 degree", "rad", "rad"},
}};

bool names_hertz(std::string_view unit) {
  return unit.find("Hz") != std::string_view::npos || unit.find("hertz") != std::string_view::npos;
}

// One `unit` in the dimension's SI unit; 0 if it measures something else. The library treats angles as pure numbers, so
// a frequency would otherwise pass for a speed.
double factor(const Unit& unit, std::string_view unit_text, Dimension wanted) {
  const double one = unit.worth_in(Unit(words(wanted).si));
  if (one == 0.0) return 0.0;
  if (wanted == Dimension::angle && !unit.counts_radians()) return 0.0;
  if (wanted == Dimension::speed && !unit.counts_radians()) return names_hertz(unit_text) ? 2.0 * pi * one : 0.0;
  if (wanted != Dimension::speed && names_hertz(unit_text)) return 0.0;  // turns or radians?
  return one;
}

std::string wanted_text(const std::vector<Dimension>& wanted) {
  std::string text;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    text += fmt::format("{}{}, such as \"{}\"", i ? ", or " : "", words(wanted[i]).name, words(wanted[i]).example);
  return text;
}

std::string trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return std::string(text);
}

}  // namespace

const DimensionWords& words(Dimension dimension) { return all_words.at(static_cast<std::size_t>(dimension)); }

ShownUnit shown_unit(Dimension d, const std::optional<model::Scales>& scales) {
  if (!scales) return {words(d).dimensionless, 1.0};
  const double si = scale_of(d, *scales);
  return {words(d).shown, d == Dimension::length || d == Dimension::velocity ? 1000.0 * si
                          : d == Dimension::speed                            ? 30.0 / pi * si
                          : d == Dimension::unbalance                        ? 1e6 * si
                                                                             : si};
}

double scale_of(Dimension dimension, const model::Scales& s) {
  switch (dimension) {
    case Dimension::mass:
      return s.mass;
    case Dimension::length:
      return s.length;
    case Dimension::time:
      return s.time();
    case Dimension::speed:
      return s.frequency;
    case Dimension::velocity:
      return s.velocity();
    case Dimension::acceleration:
      return s.acceleration();
    case Dimension::force:
      return s.force();
    case Dimension::stiffness:
      return s.stiffness();
    case Dimension::damping:
      return s.damping();
    case Dimension::torque:
      return s.torque();
    case Dimension::gain:
      return s.gain();
    case Dimension::inertia:
      return s.inertia();
    case Dimension::energy:
      return s.torque();
    case Dimension::power:
      return s.torque() * s.frequency;
    case Dimension::unbalance:
      return s.unbalance();
    case Dimension::angle:
      return 1.0;
    case Dimension::density:
    case Dimension::viscosity:
    case Dimension::kinematic_viscosity:
      break;
  }
  throw std::logic_error("no dimensionless study has this dimension");
}

Measured measure(const std::string& text, const std::vector<Dimension>& wanted) {
  const std::string quantity = trimmed(text);
  const std::string must_be = "must be " + wanted_text(wanted);
  Measured result;
  const std::size_t sign = !quantity.empty() && quantity.front() == '+' ? 1 : 0;  // read_number() accepts none
  const char* end = quantity.data() + quantity.size();
  const auto [after, error] = read_number(quantity.data() + sign, end, result.value);
  if (error == std::errc::invalid_argument) {
    result.problem = "does not begin with a number; " + must_be;
    return result;
  }
  if (error != std::errc() || !std::isfinite(result.value)) {
    result.problem = "the number is out of range; " + must_be;
    return result;
  }
  const std::string unit_text = trimmed({after, static_cast<std::size_t>(end - after)});
  if (unit_text.empty()) {
    result.problem = "has no unit; " + must_be;
    return result;
  }
  const UnitLibraryUse use;
  const UnitText checked(unit_text);
  if (!checked.is_product) {
    result.problem = "is no number with a unit; " + must_be;
    return result;
  }
  for (const std::string& name : checked.names) {
    if (Unit(name).is_known()) continue;
    result.problem = fmt::format("{} knows no unit \"{}\"; {}", Unit::reader(), display_text(name), must_be);
    return result;
  }
  const Unit unit(checked.text);
  if (!unit.is_known()) {
    result.problem = fmt::format("{} cannot read the unit \"{}\"; {}", Unit::reader(), unit_text, must_be);
    return result;
  }
  for (const Dimension dimension : wanted) {
    const double one = factor(unit, unit_text, dimension);
    if (one == 0.0) continue;
    result.value *= one;
    result.dimension = dimension;
    return result;
  }
  result.problem = fmt::format("\"{}\" does not measure that; {}", unit_text, must_be);
  if (wanted.front() == Dimension::speed) result.problem += "; in rpm, rad/s or Hz (turns a second)";
  return result;
}

std::string quantity_text(double si, Dimension dimension) {
  const UnitLibraryUse use;
  const Unit shown(words(dimension).shown);
  return fmt::format("{} {}", si / factor(shown, words(dimension).shown, dimension), words(dimension).shown);
}

}  // namespace equipoise::study
