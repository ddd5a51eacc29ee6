// The speeds from which drag carries balls round, in words.
#include "equipoise/report/text/carrying_text.hpp"

#include <cmath>

#include <fmt/format.h>

#include "equipoise/report/text/text.hpp"

namespace equipoise {

std::optional<model::Carrying> carrying(const Study& study) { return model::carrying(study.parameters, study.drive()); }

std::string carried_text(const Study& study, const model::Carrying& c) {
  if (std::isinf(c.all)) return "balls without drag are never carried round";
  const std::string all = rotor_speed_text(study, c.all), first = rotor_speed_text(study, c.first);
  return first == all
             ? fmt::format("drag carries hanging balls round from {} on", all)
             : fmt::format("drag carries the first of hanging balls round from {} on, all from {} on", first, all);
}

std::string hanging_text(const Study& study) {
  const auto c = carrying(study);
  if (!c || !c->may_hang()) return "";
  const std::string carried = carried_text(study, *c);
  const double factor = c->all / c->reached;
  return std::isinf(factor)
             ? fmt::format("balls that hang below the shaft at the final speed stay there and balance nothing: {}",
                           carried)
             : fmt::format(
                   "balls that hang below the shaft at the final speed stay there and balance nothing: {}; at the "
                   "speed reached it takes {:.3g} times the drag",
                   carried, factor);
}

}  // namespace equipoise
