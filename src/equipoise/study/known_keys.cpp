// Unknown keys, and the nearest known names.
#include "equipoise/study/known_keys.hpp"

#include <algorithm>
#include <numeric>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/study/keys.hpp"
#include "equipoise/toml/printable.hpp"

namespace equipoise::study {

namespace {

using Names = std::vector<std::string>;

// A misspelling is at most this many edits away.
constexpr std::size_t nearest_distance = 2;

Names names_in(const std::vector<Key>& keys) {
  Names names;
  for (const Key& key : keys) names.emplace_back(key.name);
  return names;
}

// Keys that the table may hold. Without a valid profile: the keys of all profiles.
Names names_in(const Document& document, const KeyTable& table, bool physical) {
  const StudyValue* profile = table.find("profile", false) ? document.root.find_path(table.name + ".profile") : nullptr;
  const auto at = std::find(profile_names.begin(), profile_names.end(),
                            profile && profile->string() ? std::string_view(*profile->string()) : "");
  const auto said = static_cast<Profile>(at - profile_names.begin());
  return names_in(table.of(at == profile_names.end() ? all_variants : variant_of(said), physical));
}

// Common names for things that have another name here.
constexpr std::string_view other_names =
    "ball_count balls, number_of_balls balls, n_balls balls, count balls, ball_mass mass, ball_drag drag, "
    "damping_coefficient drag, viscosity oil_viscosity, radius race_radius, diameter ball_diameter, "
    "density ball_density, ball_size ball_diameter, friction rolling, natural_frequency stiffness, "
    "critical_speed stiffness, spring stiffness, k stiffness, m mass, c damping, zeta damping_ratio, "
    "zeta damping, damping_factor damping_ratio, damping_ratio damping, imbalance unbalance, "
    "imbalance eccentricity, unbalance eccentricity, offset eccentricity, moment_of_inertia inertia, "
    "speed final, final_speed final, final speed, start initial, time duration, free_speed no_load_speed, "
    "stall_torque stall, balls balancer";

bool holds(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The longer name begins or ends with the shorter one: "race_radius_mm", "support_stiffness".
bool extends(std::string_view longer, std::string_view shorter) {
  return shorter.size() >= 4 && longer.size() > shorter.size() &&
         (longer.starts_with(shorter) || longer.ends_with(shorter));
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

// The known name that was probably meant, or an empty one.
std::string meant(std::string_view key, const Names& known) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edit_distance(key.substr(0, longest_shown), a) < edit_distance(key.substr(0, longest_shown), b);
  });
  if (nearest != known.end() && nearly_same(key, *nearest)) return *nearest;
  std::istringstream others{std::string(other_names)};
  for (std::string said, name; others >> said && std::getline(others >> std::ws, name, ',');)
    if (key == said && holds(known, name)) return name;
  for (const std::string& name : known)
    if (extends(key, name) || extends(name, key)) return name;
  return "";
}

}  // namespace

bool nearly_same(std::string_view a, std::string_view b) {
  return a.size() <= longest_shown && b.size() <= longest_shown && edit_distance(a, b) <= nearest_distance;
}

std::string unknown_key(std::string_view table, std::string_view key, const Names& known) {
  // As --set writes it.
  if (!table.empty() && key.starts_with(fmt::format("{}.", table))) key.remove_prefix(table.size() + 1);
  const std::string other = holds(known, key) ? std::string(key) : meant(key, known);
  return fmt::format("unknown key{} (allowed: {})", other.empty() ? "" : fmt::format("; did you mean \"{}\"?", other),
                     fmt::join(known, ", "));
}

void check_tables(const Document& document) {
  Names tables;
  for (const KeyTable& table : key_tables())
    if (!table.is_inner()) tables.push_back(table.name);
  for (const auto& [name, value] : *document.root.table())
    if (!holds(tables, name))
      throw InputError(document.where(name, &value), printable(name), document.value_text("", value),
                       unknown_key("", name, tables));
}

void check_keys(const Document& document, bool physical) {
  for (const KeyTable& list : key_tables()) {
    const StudyValue* table = document.root.find_path(list.name);
    if (!table || !table->table() || list.keys.empty()) continue;
    for (const auto& [name, value] : *table->table()) {
      if (list.find(name, physical)) continue;
      const std::string dotted = list.name + "." + name;
      std::string problem = unknown_key(list.name, name, names_in(document, list, physical));
      const auto home = std::find_if(key_tables().begin(), key_tables().end(), [&, key = name](const KeyTable& other) {
        return holds(names_in(document, other, physical), key);
      });
      if (home != key_tables().end() && problem.find("did you mean") == std::string::npos)
        problem += fmt::format("; [{}] has a key of this name", home->name);
      throw InputError(document.where(dotted, &value), list.name + "." + printable(name),
                       document.value_text(dotted, value), problem);
    }
  }
}

}  // namespace equipoise::study
