// The resolved study as a tree and as TOML, as results keep it, and in physical units.
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "equipoise/core/base/error.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/echo/physical_echo.hpp"
#include "equipoise/study/toml/toml_tree.hpp"

namespace equipoise {

namespace {
using namespace study;

// A table's keys that a dimensionless study has, as quantities if `physical`.
StudyValue table_of(std::string_view name, const Study& study, bool physical = false) {
  StudyValue table;
  const unsigned variants = variants_in(study, name);
  for (const Key& key : key_table(name).keys)
    if (key.in_form(false) && (!key.variants() || key.variants() & variants) && (!key.echoed || key.echoed(study)))
      if (auto value = value_of(key, study, entry_of(name), physical)) table.set(key.name, *std::move(value));
  return table;
}

void move_to_end(StudyValue& table, const char* key) {
  const StudyValue value = *table.find(key);
  table.erase(key);
  table.set(key, value);
}

// Whether such a study has the table.
bool has_table(const Study& study, const KeyTable& table, bool physical) {
  const std::string& name = table.name;
  const SpeedSetting& speed = study.speed;
  if (name == "units") return study.scales && !physical;
  if (name == "rotor.tilt") return study.parameters.tilts();
  if (name == "speed.torque") return speed.driven();
  if (name == "speed.torque.target") return speed.driven() && speed.torque.kind == model::MotorLaw::Kind::control;
  const auto of_load = [](const UncertainValue& value) { return value.key.starts_with("speed.load."); };
  const std::vector<UncertainValue>& drawn = study.uncertain.values;
  if (name == "speed.load")
    return speed.driven() &&
           (!speed.load.is_none() || speed.load.at || std::any_of(drawn.begin(), drawn.end(), of_load));
  if (name == "sampling.box") return !study.sampling.box.empty();
  return !table.is_inner() && name != "sweep";
}

StudyValue tree_with_medians(const Study& study, bool physical = false) {
  StudyValue tree;
  for (const KeyTable& keys : key_tables()) {
    if (!has_table(study, keys, physical)) continue;
    StudyValue table = table_of(keys.name, study, physical);
    if (keys.name == "speed") move_to_end(table, "law");
    if (keys.name == "sampling") move_to_end(table, "method");
    const std::size_t dot = keys.name.rfind('.') + 1;  // npos + 1 = 0
    StudyValue* home = dot > 0 ? tree.find_path(keys.name.substr(0, dot - 1)) : &tree;
    if (dot > 0 || !table.table()->empty()) home->set(keys.name.substr(dot), std::move(table));
  }
  return tree;
}

// Updates what may have changed since the study was read: sampling and numerical settings.
void update_written(const Study& study, StudyValue& tree) {
  const bool same_horizon = study.numerics.horizon == study.uncertain.horizon;  // it stays as it was written
  for (const char* name : {"sampling", "numerics"}) {
    StudyValue* table = tree.find(name);
    if (!table) table = &tree.set(name, {});
    const StudyValue now = table_of(name, study, true);
    for (const auto& [key, value] : *now.table())
      if (key != "horizon" || !same_horizon) table->set(key, value);
  }
}

// Keys in a reader's order, so that the text does not depend on their order in the source.
StudyValue sorted(const StudyValue& value) {
  if (const StudyValue::Array* array = value.array()) {
    StudyValue::Array entries;
    for (const StudyValue& entry : *array) entries.push_back(sorted(entry));
    return entries;
  }
  const StudyValue::Table* members = value.table();
  if (!members) return value;
  std::vector<const StudyValue::Member*> order;
  for (const StudyValue::Member& member : *members) order.push_back(&member);
  std::sort(order.begin(), order.end(), [](const auto* a, const auto* b) { return a->key < b->key; });
  StudyValue result;
  for (const StudyValue::Member* member : order) result.set(member->key, sorted(member->value));
  return result;
}

void put_distributions(const Study& study, StudyValue& tree) {
  for (const UncertainValue& value : study.uncertain.values) {
    const std::size_t dot = value.key.rfind('.');
    if (StudyValue* table = tree.find_path(std::string_view(value.key).substr(0, dot)))
      table->set(value.key.substr(dot + 1), value.written());
    // Stiction that is not stated follows the draw.
    if (value.key == "balancer.rolling" && study.parameters.stiction == study.parameters.rolling)
      tree.find("balancer")->erase("stiction");
  }
  if (study.uncertain.rests)
    for (const char* key : {"x", "y", "x_dot", "y_dot", "tilt_x", "tilt_y", "tilt_x_dot", "tilt_y_dot"})
      tree.find("initial")->erase(key);
}

}  // namespace

StudyValue to_tree(const Study& study) {
  if (!study.uncertain.physical) {
    StudyValue tree = tree_with_medians(study);
    put_distributions(study, tree);
    return tree;
  }
  StudyValue tree = *study.uncertain.physical;
  update_written(study, tree);
  return sorted(tree);
}

Study stating_release(Study study) {
  if (!study.release.speed && !study.release.time && !study.speed.driven()) study.release.time = study.release_time();
  return study;
}

std::string to_physical_toml(const Study& study) {
  if (!study.scales)
    throw InputError(study.name, "units", "", "missing; a dimensionless study is shown in physical units by [units]");
  StudyValue tree = tree_with_medians(stating_release(with_medians(study)), true);
  find_table(tree, "rotor")->set("mass", quantity_text(study.scales->mass, Dimension::mass));
  find_table(tree, "balancer")->set("race_radius", quantity_text(study.scales->length, Dimension::length));
  return toml_text(tree);
}

std::string to_toml(const Study& study) { return to_toml(to_tree(study)); }

std::string to_toml(const StudyValue& tree) { return study::toml_text(tree); }

}  // namespace equipoise
