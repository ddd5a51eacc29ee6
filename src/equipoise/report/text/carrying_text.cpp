// The speeds from which drag carries balls round, in words.
#include "equipoise/report/text/carrying_text.hpp"

#include <cmath>

#include <fmt/format.h>

#include "equipoise/report/text/text.hpp"
#include "equipoise/report/words/text.hpp"

namespace equipoise {

std::optional<model::Carrying> carrying(const Study& study) { return model::carrying(study.parameters, study.drive()); }

std::string carried_text(const Study& study, const model::Carrying& c) {
  if (std::isinf(c.all)) return words::text::some_never_carried;
  const std::string all = rotor_speed_text(study, c.all), first = rotor_speed_text(study, c.first);
  return first == all ? fmt::format(words::text::carried_from, all)
                      : fmt::format(words::text::carried_one_by_one, first, all);
}

std::string hanging_text(const Study& study) {
  const auto c = carrying(study);
  if (!c || !c->may_hang()) return "";
  const std::string carried = carried_text(study, *c);
  const double factor = c->all / c->reached;
  return std::isinf(factor) ? fmt::format(words::text::balls_stay_hanging_without_drag, carried)
                            : fmt::format(words::text::balls_stay_hanging, carried, factor);
}

}  // namespace equipoise
