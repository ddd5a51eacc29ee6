// The table of keys by tables, lookups in it, which keys a variant of a table has; unknown keys, and the nearest known
// names.
#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/nearest_name.hpp"
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

std::vector<const Key*> ways_of(std::string_view dotted) {
  const auto [table, key, entry] = find_key(dotted, true);
  std::vector<const Key*> ways;
  if (key && key->way.of)
    for (const Key& other : table->keys)
      if (other.way.of && std::string_view(other.way.of) == key->way.of) ways.push_back(&other);
  return ways;
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

unsigned variants_in(const Study& study, std::string_view table) {
  if (table == "speed") return variant_of(study.speed.profile);
  if (table == "speed.torque") return variants_of(study.speed.torque);
  return table == "speed.torque.target" ? variant_of(study.speed.torque.target.profile) : all_variants;
}

namespace {

using Names = std::vector<std::string>;

Names names_in(const std::vector<Key>& keys) {
  Names names;
  for (const Key& key : keys) names.emplace_back(key.name);
  return names;
}

// Keys that the table may hold. Without a valid profile: the keys of all profiles.
Names names_in(const StudyFile& file, const KeyTable& table, bool physical) {
  const std::string* profile = table.find("profile", false) ? file.root.find_text(table.name + ".profile") : nullptr;
  const auto at = std::find(profile_names.begin(), profile_names.end(), profile ? std::string_view(*profile) : "");
  const auto said = static_cast<Profile>(at - profile_names.begin());
  return names_in(table.of(at == profile_names.end() ? all_variants : variant_of(said), physical));
}

// A thing here, and common names for it.
struct OtherNames {
  std::string_view name, said;
};
constexpr auto other_names = std::to_array<OtherNames>({
    {"balls", "ball_count number_of_balls n_balls count"},
    {"mass", "ball_mass m"},
    {"drag", "ball_drag damping_coefficient"},
    {"oil_viscosity", "viscosity"},
    {"race_radius", "radius"},
    {"ball_diameter", "diameter ball_size"},
    {"ball_density", "density"},
    {"rolling", "friction"},
    {"natural_frequency", "critical_speed"},
    {"stiffness", "natural_frequency critical_speed spring k"},
    {"static_sag", "sag"},
    {"logarithmic_decrement", "decrement log_decrement"},
    {"quality_factor", "q_factor"},
    {"loss_factor", "eta loss_coefficient"},
    {"race_diameter", "pitch_diameter"},
    {"balance_grade", "grade"},
    {"radius_of_gyration", "gyration_radius"},
    {"gd2", "gd"},
    {"ball_material", "material"},
    {"place", "places"},
    {"damping_ratio", "zeta damping_factor"},
    {"damping", "c zeta damping_ratio"},
    {"unbalance", "imbalance"},
    {"eccentricity", "imbalance unbalance offset"},
    {"inertia", "moment_of_inertia"},
    {"final", "speed final_speed"},
    {"speed", "final"},
    {"initial", "start"},
    {"duration", "time"},
    {"no_load_speed", "free_speed"},
    {"stall", "stall_torque"},
    {"balancer", "balls"},
});

bool holds(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The longer name begins or ends with the shorter one: "race_radius_mm", "support_stiffness".
bool extends(std::string_view longer, std::string_view shorter) {
  return shorter.size() >= 4 && longer.size() > shorter.size() &&
         (longer.starts_with(shorter) || longer.ends_with(shorter));
}

// The known name that was probably meant, or an empty one.
std::string meant(std::string_view key, const Names& known) {
  if (std::string nearest = nearest_name(key, known); !nearest.empty()) return nearest;
  for (const auto& [name, said] : other_names)
    if (is_among(said, key) && holds(known, name)) return std::string(name);
  for (const std::string& name : known)
    if (extends(key, name) || extends(name, key)) return name;
  return "";
}

// The known name that a key stands for, which may carry its table's name as --set writes it.
std::string likely(std::string_view table, std::string_view key, const Names& known) {
  if (!table.empty() && key.starts_with(fmt::format("{}.", table))) key.remove_prefix(table.size() + 1);
  return holds(known, key) ? std::string(key) : meant(key, known);
}

}  // namespace

std::string unknown_key(std::string_view table, std::string_view key, const Names& known) {
  const std::string other = likely(table, key, known);
  return fmt::format("unknown key{} (allowed: {})", other.empty() ? "" : fmt::format("; did you mean \"{}\"?", other),
                     fmt::join(known, ", "));
}

void check_tables(const StudyFile& file) {
  Names tables;
  for (const KeyTable& table : key_tables())
    if (!table.is_inner()) tables.push_back(table.name);
  for (const auto& [name, value] : *file.root.table())
    if (!holds(tables, name))
      throw InputError(file.where(name, &value), shown_text(name), file.value_text("", value),
                       unknown_key("", name, tables));
}

namespace {
void check_keys_of(const StudyFile& file, bool physical, const KeyTable& list, const std::string& path) {
  const StudyValue* table = file.root.find_path(path);
  if (!table || !table->table() || list.keys.empty()) return;
  for (const auto& [name, value] : *table->table()) {
    if (list.find(name, physical)) continue;
    const std::string dotted = path + "." + name;
    const Names known = names_in(file, list, physical);
    std::string problem = unknown_key(list.name, name, known);
    const auto home = std::find_if(key_tables().begin(), key_tables().end(), [&, key = name](const KeyTable& other) {
      return holds(names_in(file, other, physical), key);
    });
    if (home != key_tables().end() && likely(list.name, name, known).empty())
      problem += fmt::format("; [{}] has a key of this name", home->name);
    throw InputError(file.where(dotted, &value), path + "." + shown_text(name), file.value_text(dotted, value),
                     problem);
  }
}
}  // namespace

void check_keys(const StudyFile& file, bool physical) {
  for (const KeyTable& list : key_tables())
    for (const std::string& path : paths_of(file.root, list.name)) check_keys_of(file, physical, list, path);
}

}  // namespace equipoise::study
