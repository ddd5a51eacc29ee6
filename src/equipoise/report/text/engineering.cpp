// Units by dimension and size.
#include "equipoise/report/text/engineering.hpp"

#include <cmath>
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

}  // namespace equipoise
