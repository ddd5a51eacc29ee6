// The dimension of each quantity, and conversion of its numbers.
#include "equipoise/study/units/units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/nearest_name.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/study/units/unit_table.hpp"

namespace equipoise::study {

namespace {

constexpr char no_number_with_unit[] = "is not a number with a unit";
constexpr char measures_something_else[] = "\"{}\" is a unit of something else";

template <auto member>
double by(const model::Scales& scales) {
  return std::invoke(member, scales);
}
using S = model::Scales;

constexpr std::array<DimensionWords, 22> all_words{{
    {"a mass", "kg", "12 kg", "kg", "", by<&S::mass>},
    {"a length", "m", "0.2 mm", "mm", "R", by<&S::length>},
    {"a time", "s", "10 s", "s", "1/omega_c", by<&S::time>},
    {"a speed of rotation", "rad/s", "3000 rpm", "rpm", "omega_c", by<&S::frequency>},
    {"a velocity", "m/s", "4.5 mm/s", "mm/s", "R omega_c", by<&S::velocity>},
    {"an acceleration", "m/s2", "9.81 m/s2", "m/s2", "", by<&S::acceleration>},
    {"a force", "N", "500 N", "N", "M R omega_c^2", by<&S::force>},
    {"a stiffness", "N/m", "48 kN/m", "N/m", "", by<&S::stiffness>},
    {"a damping coefficient", "N s/m", "200 N s/m", "N s/m", "", by<&S::damping>},
    {"a torque", "N m", "0.5 N m", "N m", "", by<&S::torque>},
    {"a torque for a speed of rotation", "N m s", "0.01 N m s", "N m s", "", by<&S::gain>},
    {"a moment of inertia", "kg m2", "0.02 kg m2", "kg m2", "", by<&S::inertia>},
    {"an energy", "J", "20 J", "J", "M R^2 omega_c^2", by<&S::torque>},
    {"a power", "W", "1.5 kW", "W", "M R^2 omega_c^3", [](const S& s) { return s.torque() * s.frequency; }},
    {"an unbalance", "kg m", "300 g mm", "g mm", "M R", by<&S::unbalance>},
    {"a density", "kg/m3", "7800 kg/m3", "kg/m3"},
    {"a viscosity", "Pa s", "100 mPa s", "mPa s"},
    {"a kinematic viscosity", "m2/s", "100 cSt", "cSt"},
    {"an angle", "rad", "30 degree", "rad", "rad", [](const S&) { return 1.0; }},
    {"a temperature", "K", "40 degC", "K"},
    {"a weight times a diameter squared", "N m2", "0.3 kgf m2", "N m2"},
    {"a force for a speed of tilting", "N s", "2 N s", "N s", "", [](const S& s) { return s.damping() * s.length; }},
}};

bool names_hertz(std::string_view unit) {
  return unit.find("Hz") != std::string_view::npos || unit.find("hertz") != std::string_view::npos;
}

// What everyone reads as turns per minute. A bare 1/s may be turns or radians.
bool names_turns_a_minute(std::string_view unit) { return is_among("min-1 min^-1 1/min", unit); }

// Scales with a zero of their own: no product of units.
struct TemperatureScale {
  std::string_view names;
  double kelvin, zero;  // of one degree; of 0 degrees
};
constexpr std::array<TemperatureScale, 3> temperature_scales{
    {{"degC C celsius \u00B0C \u2103", 1.0, 273.15},
     {"degF F fahrenheit \u00B0F", 5.0 / 9.0, 459.67 * 5.0 / 9.0},
     {"K", 1.0, 0.0}}};

// One `unit` in the dimension's SI unit; 0 if it measures something else. The table treats angles as pure numbers, so a
// frequency would otherwise pass for a speed.
double factor(const TableUnit& unit, std::string_view unit_text, Dimension wanted) {
  const double one = unit.worth_in(*table_unit(words(wanted).si));
  if (one == 0.0) return 0.0;
  if (wanted == Dimension::angle && !unit.counts_radians()) return 0.0;
  if (wanted == Dimension::speed && !unit.counts_radians())
    return names_hertz(unit_text) || names_turns_a_minute(unit_text) ? 2.0 * pi * one : 0.0;
  if (wanted != Dimension::speed && names_hertz(unit_text)) return 0.0;  // turns or radians?
  return one;
}

bool measures(const std::string& unit, Dimension wanted) {
  if (const auto known = table_unit(unit)) return factor(*known, unit, wanted) != 0.0;
  return wanted == Dimension::temperature;  // the usual ones next to the table
}

// " (did you mean "rpm"?)" of names that differ in small and capital letters, or in one letter of three or more. Where
// the name is all of the unit, of those that measure what is wanted.
std::string unit_hint(const std::string& name, bool alone, const std::vector<Dimension>& wanted) {
  static const std::vector<std::string> usual{"kg",  "mm",  "um",  "rpm", "rad",    "Hz",    "min",    "kN",
                                              "MN",  "Pa",  "mPa", "cSt", "degree", "degC",  "inch",   "gram",
                                              "lbf", "kgf", "ozf", "psi", "metre",  "meter", "newton", "second"};
  std::vector<std::string> fitting;
  for (const std::string& unit : usual)
    if (!alone || std::any_of(wanted.begin(), wanted.end(), [&](Dimension d) { return measures(unit, d); }))
      fitting.push_back(unit);
  const std::string near = nearest_name(name, fitting);
  return near.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", near);
}

// A whole number of up to four digits at the front; removes it. 0 if there is none.
int take_whole(std::string_view& text) {
  int number = 0;
  std::size_t digits = 0;
  for (; digits < text.size() && digits < 4 && text[digits] >= '0' && text[digits] <= '9'; ++digits)
    number = 10 * number + (text[digits] - '0');
  text.remove_prefix(digits);
  return number;
}

// "/4 in" after 3, " 1/2 in" after 1: the value, and what is left of the text. A blank has to follow: "2 1/m" is none.
bool take_fraction(double& value, std::string_view& text) {
  std::string_view rest = text;
  const bool whole_first = !rest.empty() && rest.front() == ' ';
  rest = trimmed(rest);
  const int over = whole_first ? take_whole(rest) : 1;
  if (over == 0 || rest.empty() || rest.front() != '/') return false;
  rest.remove_prefix(1);
  const int under = take_whole(rest);
  if (under == 0 || rest.empty() || rest.front() != ' ' || value != std::floor(value)) return false;
  if (whole_first && value < 0.0)
    value -= static_cast<double>(over) / under;
  else
    value = whole_first ? value + static_cast<double>(over) / under : value / under;
  text = rest;
  return true;
}

}  // namespace

std::string wanted_text(const std::vector<Dimension>& wanted, const std::string& bound) {
  std::string text;
  for (const Dimension d : wanted)
    text += fmt::format("{}{}{}, such as \"{}\"", text.empty() ? "" : ", or ", words(d).name, bound, words(d).example);
  return text;
}

const DimensionWords& words(Dimension dimension) { return all_words.at(static_cast<std::size_t>(dimension)); }

ShownUnit shown_unit(Dimension d, const std::optional<model::Scales>& scales) {
  if (!scales) return {words(d).dimensionless, 1.0};
  const double si = scale_of(d, *scales);
  return {words(d).shown, d == Dimension::length || d == Dimension::velocity ? 1000.0 * si
                          : d == Dimension::speed                            ? 30.0 / pi * si
                          : d == Dimension::unbalance                        ? 1e6 * si
                                                                             : si};
}

double scale_of(Dimension dimension, const model::Scales& scales) {
  if (const auto scale = words(dimension).scale) return scale(scales);
  throw std::logic_error("no dimensionless study has this dimension");
}

NumberAndUnit split_quantity(std::string_view text) {
  NumberAndUnit result;
  const std::string_view quantity = trimmed(text);
  const std::size_t sign = !quantity.empty() && quantity.front() == '+' ? 1 : 0;  // read_number() accepts none
  const char* end = quantity.data() + quantity.size();
  const auto [after, error] = read_number(quantity.data() + sign, end, result.number);
  result.error = error;
  if (error == std::errc::invalid_argument) return result;
  std::string_view rest(after, static_cast<std::size_t>(end - after));
  take_fraction(result.number, rest);
  result.unit = trimmed(rest);
  return result;
}

std::optional<double> percentage(std::string_view text) {
  const NumberAndUnit parts = split_quantity(text);
  if (parts.error != std::errc() || parts.unit != "%") return std::nullopt;
  return parts.number / 100.0;
}

Measured measure(const std::string& text, const std::vector<Dimension>& wanted) {
  Measured result;
  const auto [number, unit_text, error] = split_quantity(text);
  result.value = number;
  const auto refused = [&](const std::string& problem) {
    result.problem = fmt::format("{}; must be {}", problem, wanted_text(wanted));
    return result;
  };
  if (error == std::errc::invalid_argument) return refused("does not begin with a number");
  if (error != std::errc() || !std::isfinite(number)) return refused("the number is out of range");
  if (unit_text.empty()) return refused("has no unit");
  for (const TemperatureScale& scale : temperature_scales) {
    if (!is_among(scale.names, unit_text)) continue;
    if (std::find(wanted.begin(), wanted.end(), Dimension::temperature) == wanted.end())
      return refused(fmt::format(measures_something_else, unit_text));
    result.value = number * scale.kelvin + scale.zero;
    result.dimension = Dimension::temperature;
    return result;
  }
  const UnitText checked(unit_text);
  if (!checked.is_product) return refused(no_number_with_unit);
  if (!checked.unknown.empty())
    return refused(fmt::format("\"{}\" is not a known unit{}", display_text(checked.unknown),
                               unit_hint(checked.unknown, checked.names == 1, wanted)));
  if (!checked.unit) return refused(no_number_with_unit);
  for (const Dimension dimension : wanted) {
    const double one = factor(*checked.unit, checked.text, dimension);
    if (one == 0.0) continue;
    result.value *= one;
    result.dimension = dimension;
    return result;
  }
  refused(fmt::format(measures_something_else, unit_text));
  if (wanted.front() == Dimension::speed) result.problem += "; in rpm, 1/min, rad/s or Hz (turns per second)";
  return result;
}

std::string quantity_text(double si, Dimension dimension) {
  const TableUnit shown = *table_unit(words(dimension).shown);
  return fmt::format("{} {}", si / factor(shown, words(dimension).shown, dimension), words(dimension).shown);
}

}  // namespace equipoise::study
