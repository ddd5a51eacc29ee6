// The table of keys by tables, lookups in it, and which keys a variant of a table has.
#include <algorithm>

#include "equipoise/study/contents/keys.hpp"

namespace equipoise::study {

namespace {
using enum Key::Trait;

std::vector<KeyTable> make_tables() {
  std::vector<KeyTable> tables;
  const auto table = [&](std::string_view name) -> KeyTable& {
    const auto found = std::find_if(tables.begin(), tables.end(), [&](const KeyTable& t) { return t.name == name; });
    return found == tables.end() ? tables.emplace_back(KeyTable{std::string(name), {}}) : *found;
  };
  for (Key key : all_keys()) {
    const std::string_view dotted = key.name;
    const std::size_t dot = std::min(dotted.rfind('.'), dotted.size());
    KeyTable& home = table(dotted.substr(0, dot));
    if (dot == dotted.size()) continue;
    key.name += dot + 1;
    home.keys.push_back(key);
  }
  // A motor's target is a ramp function, as in [speed].
  std::vector<Key> target = table("speed").keys;
  std::erase_if(target, [](const Key& key) { return std::string_view(key.name) == "law" || key.has(Key::physical); });
  for (Key& key : target) {
    key.label = nullptr;
    if (key.variants() == driven) key.dimension = {};  // no target has them
  }
  const auto after = std::find_if(tables.begin(), tables.end(), [](const KeyTable& t) { return t.name == "release"; });
  tables.insert(after, {"speed.torque.target", std::move(target)});
  return tables;
}

}  // namespace

const std::vector<KeyTable>& key_tables() {
  static const std::vector<KeyTable> tables = make_tables();
  return tables;
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

KeyPlace find_key(std::string_view dotted, bool physical) {
  const std::size_t dot = std::min(dotted.rfind('.'), dotted.size());
  const KeyTable* table = dot < dotted.size() ? find_keys(dotted.substr(0, dot)) : nullptr;
  const Key* key = table ? table->find(dotted.substr(dot + 1), physical) : nullptr;
  return key ? KeyPlace{table, key, entry_of(dotted.substr(0, dot))} : KeyPlace{};
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
