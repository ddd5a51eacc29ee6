// Which unit a value beside a study is given in.
#include "equipoise/study/given_value.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "equipoise/base/read_number.hpp"
#include "equipoise/study/physical_keys.hpp"

namespace equipoise::study {

std::optional<ValueUnit> unit_of(const Study& study, Dimension dimension) {
  if (!study.scales) return std::nullopt;
  return ValueUnit{dimension, scale_of(dimension, *study.scales)};
}

std::optional<ValueUnit> unit_of(const Study& study, const std::string& key) {
  for (const auto& [table, name, dimension] : rotor_and_balancer)
    if (key == std::string(table) + "." + name) return unit_of(study, dimension);
  const model::Parameters& p = study.parameters;
  const auto last = p.mass.begin() + p.balls;
  if (key == "balancer.drag" && std::equal(p.mass.begin() + 1, last, p.mass.begin())) {
    auto unit = unit_of(study, Dimension::gain);  // D = beta m R^2 omega_c
    if (unit) unit->scale *= p.mass.front();
    return unit;
  }
  for (const QuantityTable& table : quantity_tables())
    for (const QuantityKey& entry : table.keys)
      if (key == table.name + "." + entry.key) return unit_of(study, entry.dimension);
  return std::nullopt;
}

GivenValue read_given(const std::string& text, const std::optional<ValueUnit>& unit) {
  GivenValue given;
  const char* end = text.data() + text.size();
  const auto [after, error] = read_number(text.data(), end, given.value);
  if (error == std::errc() && after == end && std::isfinite(given.value)) return given;
  if (!unit) {
    given.problem = "is no plain number";
    return given;
  }
  const Measured measured = measure(text, {unit->dimension});
  given.value = measured.value / unit->scale;
  given.problem = measured.problem;
  return given;
}

}  // namespace equipoise::study
