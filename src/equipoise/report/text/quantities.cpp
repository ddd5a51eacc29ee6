// Units by dimension and size; one unit for numbers that stand together.
#include "equipoise/report/text/quantities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"

namespace equipoise {

namespace {
using study::Dimension;

// Units that engineers use for a dimension, smallest first.
std::vector<EngineeringUnit> units_for(Dimension d) {
  switch (d) {
    case Dimension::mass:
      return {{"g", 1e-3}, {"kg", 1.0}};
    case Dimension::length:
      return {{"um", 1e-6}, {"mm", 1e-3}, {"m", 1.0}};
    case Dimension::time:
      return {{"ms", 1e-3}, {"s", 1.0}};
    case Dimension::speed:
      return {{"rpm", pi / 30.0}};
    case Dimension::velocity:
      return {{"mm/s", 1e-3}, {"m/s", 1.0}};
    case Dimension::force:
      return {{"N", 1.0}, {"kN", 1e3}};
    case Dimension::stiffness:
      return {{"N/m", 1.0}, {"kN/m", 1e3}, {"MN/m", 1e6}};
    case Dimension::unbalance:
      return {{"g mm", 1e-6}, {"kg mm", 1e-3}};
    default:
      return {{study::words(d).si, 1.0}};
  }
}

// "R omega_c^2" as pages write it.
std::string in_symbols(std::string unit) {
  for (const auto& [plain, symbol] : {std::pair{"omega_c", "ω_c"}, {"^2", "²"}})
    for (std::size_t at; (at = unit.find(plain)) != std::string::npos;)
      unit.replace(at, std::string_view(plain).size(), symbol);
  return unit;
}

// Engineers write 0.8 mm and 0.5 s rather than 800 um and 500 ms, but 0.8 N.
double unit_room(Dimension d) { return d == Dimension::length || d == Dimension::time ? 10.0 : 1.0; }

// "41.6 N", but "41.6/ω_c".
std::string with_unit(const std::string& number, const std::string& unit) {
  if (unit.starts_with("1/")) return number + unit.substr(1);
  return number + (unit.empty() ? "" : " ") + unit;
}

}  // namespace

EngineeringUnit engineering_unit(double si, Dimension d) {
  const std::vector<EngineeringUnit> units = units_for(d);
  const EngineeringUnit* chosen = &units.front();
  for (const EngineeringUnit& unit : units)
    if (std::abs(si) >= unit.si) chosen = &unit;
  if (si == 0.0) chosen = &units[units.size() / 2];
  return *chosen;
}

std::string engineering(double si, Dimension d) {
  const EngineeringUnit unit = engineering_unit(si, d);
  return fmt::format("{:.5g} {}", si / unit.si, unit.name);
}

std::string engineering(const std::optional<model::Scales>& scales, double value, Dimension d) {
  return scales ? engineering(value * study::scale_of(d, *scales), d) : fmt::format("{:.5g}", value);
}

std::string page_number(double value) {
  const double size = std::fabs(value);
  if (!(size >= 1000.0 && size < 1e7)) return fmt::format("{:.3g}", value);
  const double unit = std::pow(10.0, std::floor(std::log10(size)) - 3.0);
  return fmt::format("{:.0f}", std::round(value / unit) * unit);
}

std::string key_words(const std::string& key) {
  constexpr std::array<std::pair<const char*, const char*>, 12> known{{{"speed.final", "final speed"},
                                                                       {"speed.speed", "final speed"},
                                                                       {"rotor.unbalance", "unbalance"},
                                                                       {"rotor.eccentricity", "eccentricity"},
                                                                       {"balancer.mass", "ball mass"},
                                                                       {"balancer.drag", "ball drag"},
                                                                       {"balancer.balls", "balls"},
                                                                       {"speed.torque.stall", "stall torque"},
                                                                       {"speed.torque.no_load_speed", "no-load speed"},
                                                                       {"speed.load.constant", "constant load"},
                                                                       {"speed.load.linear", "linear load"},
                                                                       {"speed.load.quadratic", "quadratic load"}}};
  for (const auto& [name, words] : known)
    if (key == name) return words;
  constexpr std::string_view angle = "initial.phi_", rate = "initial.phi_dot_";
  if (key.starts_with(rate)) return "initial rate of ball " + key.substr(rate.size());
  if (key.starts_with(angle)) return "initial angle of ball " + key.substr(angle.size());
  std::string words = key;
  std::replace_if(
      words.begin(), words.end(), [](char c) { return c == '.' || c == '_'; }, ' ');
  return words;
}

std::string value_words(const std::string& key, const std::string& value) {
  if (value.find(' ') != std::string::npos) return value;
  if (key == "speed.final" || key == "speed.speed") return value + " ω_c";
  return key == "rotor.eccentricity" ? value + " R" : value;
}

PageQuantities::Unit PageQuantities::unit(double value, Dimension d) const {
  if (!scales_) return {in_symbols(study::words(d).dimensionless), 1.0};
  const double si = study::scale_of(d, *scales_);
  const EngineeringUnit chosen = engineering_unit(value * si * unit_room(d), d);
  return {chosen.name, si / chosen.si};
}

std::string PageQuantities::text(double value, Dimension d) const {
  const Unit u = unit(value, d);
  return with_unit(page_number(value * u.factor), u.name);
}

std::string PageQuantities::range(double low, double high, Dimension d) const {
  const Unit u = unit(std::max(std::fabs(low), std::fabs(high)), d);
  const std::string from = page_number(low * u.factor), to = page_number(high * u.factor);
  return with_unit(from == to ? to : from + " to " + to, u.name);
}

AxisWords PageQuantities::axis(const std::string& name, double largest, Dimension d) const {
  const Unit u = unit(largest, d);
  return {u.name.empty() ? name : fmt::format("{}, {}", name, u.name), u.factor};
}

}  // namespace equipoise
