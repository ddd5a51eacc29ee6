// The dimensionless echo with every quantity multiplied by its scale.
#include "equipoise/study/physical_echo.hpp"

#include <utility>

#include <fmt/format.h>

#include "equipoise/study/physical_keys.hpp"
#include "equipoise/study/toml_tree.hpp"

namespace equipoise {

namespace {
using namespace study;

// Replaces the numbers of one key by quantities; `scale` has the scale of each entry, the last one for all that follow.
void multiply(StudyValue& table, const std::string& key, Dimension dimension, const std::vector<double>& scale) {
  StudyValue* value = table.find(key);
  if (!value) return;
  const auto quantity = [&](const StudyValue& number, std::size_t i) {
    return quantity_text(number.number() * scale[std::min(i, scale.size() - 1)], dimension);
  };
  if (!value->array()) {
    *value = quantity(*value, 0);
    return;
  }
  StudyValue::Array quantities;
  for (const StudyValue& entry : *value->array()) quantities.push_back(quantity(entry, quantities.size()));
  *value = std::move(quantities);
}

void make_physical(StudyValue& root, const model::Parameters& p, const model::Scales& s) {
  StudyValue& rotor = *find_table(root, "rotor");
  const auto scaled = [&](StudyValue& table, const char* key, Dimension dimension) {
    if (dimension != Dimension::angle) multiply(table, key, dimension, {scale_of(dimension, s)});
  };
  rotor.set("mass", quantity_text(s.mass, Dimension::mass));
  StudyValue& balancer = *find_table(root, "balancer");
  balancer.set("race_radius", quantity_text(s.length, Dimension::length));
  std::vector<double> drag;  // D_i = beta_i m_i R^2 omega_c
  for (int i = 0; i < p.balls; ++i) drag.push_back(p.mass[static_cast<std::size_t>(i)] * scale_of(Dimension::gain, s));
  multiply(balancer, "drag", Dimension::gain, drag);
  for (const auto& [table, key, dimension] : rotor_and_balancer) scaled(*find_table(root, table), key, dimension);
  for (const QuantityTable& quantities : quantity_tables())
    if (StudyValue* table = find_table(root, quantities.name))
      for (const auto& [key, dimension, range] : quantities.keys) scaled(*table, key, dimension);
  root.erase("units");
}

}  // namespace

Study stating_release(Study study) {
  if (!study.release.speed && !study.release.time && !study.speed.driven()) study.release.time = study.release_time();
  return study;
}

std::string to_physical_toml(const Study& study) {
  if (!study.scales)
    throw InputError(study.name, "units", "", "missing; a dimensionless study is shown in physical units by [units]");
  StudyValue tree = to_tree(stating_release(with_medians(study)));
  make_physical(tree, study.parameters, *study.scales);
  return toml_text(tree);
}

}  // namespace equipoise
