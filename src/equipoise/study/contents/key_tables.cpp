// Lookups in the table of keys, and which keys a variant of a table has.
#include <algorithm>

#include "equipoise/study/contents/keys.hpp"

namespace equipoise::study {

namespace {
using enum Key::Trait;
}

bool KeyTable::drawn() const { return is_machine(name) || name == "release" || name.starts_with("speed"); }

const Key* KeyTable::find(std::string_view key, bool physical) const {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.name == key && k.in_form(physical); });
  return found == keys.end() ? nullptr : &*found;
}

std::vector<Key> KeyTable::of(unsigned variants, bool physical) const {
  std::vector<Key> result;
  const auto add = [&](unsigned variant) {
    for (const Key& key : keys)
      if (key.in_form(physical) && (variant ? key.variants() & variant : !key.variants()) &&
          std::none_of(result.begin(), result.end(),
                       [&](const Key& k) { return k.name == std::string_view(key.name); }))
        result.push_back(key);
  };
  add(0);
  for (unsigned variant = 1u << 8; variant <= driven; variant <<= 1)
    if (variants & variant) add(variant);
  return result;
}

const KeyTable* find_keys(std::string_view name) {
  if (const std::size_t last = name.find_last_not_of("0123456789"); last < name.size() - 1 && name[last] == '.')
    name = name.substr(0, last);
  for (const KeyTable& table : key_tables())
    if (table.name == name) return &table;
  return nullptr;
}

std::vector<std::string> paths_of(const StudyValue& root, const std::string& name) {
  const StudyValue* value = root.find_path(name);
  const StudyValue::Array* array = value ? value->array() : nullptr;
  if (!array) return {name};
  std::vector<std::string> paths;
  for (std::size_t i = 1; i <= array->size(); ++i) paths.push_back(name + "." + std::to_string(i));
  return paths;
}

const Key* find_quantity(std::string_view table, std::string_view name) {
  const KeyTable* keys = find_keys(table);
  const Key* key = keys ? keys->find(name, false) : nullptr;
  return key && key->dimension ? key : nullptr;
}

Range quantity_range(const Key& key) {
  const double low = key.range.low;
  return low < 0.0 ? any_number : low > 0.0 || key.range.low_open ? positive : not_negative;
}

unsigned variant_of(Profile profile) {
  const auto index = static_cast<unsigned>(profile);
  return index < profile_names.size() ? unsigned{constant} << index : unsigned{points};
}

unsigned variants_of(const TorqueSetting& motor) {
  using Kind = model::MotorLaw::Kind;
  // A motor of two kinds at once gets the keys of both, which no reader accepts.
  unsigned variants = motor.by_stall ? stall : 0u;
  if (motor.kind == Kind::table) return variants | curve;
  if (motor.kind == Kind::control) return variants | control;
  if (motor.kind == Kind::curve) return variants | characteristic;
  return motor.by_stall ? variants : linear;
}

}  // namespace equipoise::study
