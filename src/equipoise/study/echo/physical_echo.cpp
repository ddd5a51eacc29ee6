// The dimensionless echo with every quantity multiplied by its scale.
#include "equipoise/study/echo/physical_echo.hpp"

#include <utility>

#include <fmt/format.h>

#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/toml/toml_tree.hpp"

namespace equipoise {

namespace {
using namespace study;

// Replaces the numbers of one key by quantities. `scale`: of each entry; the last one holds for all further entries.
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

// [k12, k22] or [c12, c22], or both directions' under x and y.
void multiply_supports(StudyValue& value, Dimension across, Dimension tilt, const model::Scales& s) {
  if (value.table()) {
    for (const char* direction : {"x", "y"}) multiply_supports(*value.find(direction), across, tilt, s);
    return;
  }
  StudyValue::Array quantities;
  for (const Dimension d : {across, tilt})
    quantities.push_back(quantity_text((*value.array())[quantities.size()].number() * scale_of(d, s), d));
  value = std::move(quantities);
}

void make_physical(StudyValue& root, const model::Parameters& p, const model::Scales& s) {
  find_table(root, "rotor")->set("mass", quantity_text(s.mass, Dimension::mass));
  find_table(root, "balancer")->set("race_radius", quantity_text(s.length, Dimension::length));
  for (const KeyTable& keys : key_tables()) {
    StudyValue* table = find_table(root, keys.name);
    for (const Key& key : keys.keys) {
      if (!table || !key.in_form(false) || !key.dimension || key.dimension == Dimension::angle) continue;
      std::vector<double> scale{scale_of(*key.dimension, s)};
      if (is_machine(keys.name) && key.name == std::string_view("drag")) {  // D_i = beta_i m_i R^2 omega_c
        scale.resize(static_cast<std::size_t>(p.balls), scale[0]);
        for (std::size_t i = 0; i < scale.size(); ++i) scale[i] *= p.mass[i];
      }
      multiply(*table, key.name, *key.dimension, scale);
    }
  }
  if (StudyValue* tilt = find_table(root, "rotor.tilt")) {
    multiply_supports(*tilt->find("stiffness"), Dimension::force, Dimension::torque, s);
    multiply_supports(*tilt->find("damping"), Dimension::tilt_damping, Dimension::gain, s);
  }
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
