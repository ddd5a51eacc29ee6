// Lists of keys, and the nearest names.
#include "equipoise/study/known_keys.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/study/printable.hpp"

namespace equipoise::study {

namespace {

using Names = std::vector<std::string>;

// A misspelling is this close to what was meant.
constexpr std::size_t nearest_distance = 2;

struct KeyList {
  std::string table;
  Names keys;
  Names elsewhere = {};  // of other profiles: left behind when the profile changes, not misspelt
};

Names joined(Names first, const Names& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

const Names every_speed_key{"speed",      "initial",    "final", "duration", "peak",          "rise_until",
                            "hold_until", "fall_until", "times", "speeds",   "stalled_below", "torque"};

// Of a profile that there is none of, or that is not said, all of them.
Names keys_of_profile(const std::string& profile) {
  if (profile == "constant") return {"speed"};
  if (profile == "ramp") return {"initial", "final", "duration"};
  if (profile == "trapezoid") return {"initial", "peak", "final", "rise_until", "hold_until", "fall_until"};
  if (profile == "points") return {"times", "speeds"};
  if (profile == "torque") return {"initial", "stalled_below", "torque"};
  return every_speed_key;
}

std::string profile_in(const Document& document, const std::string& table) {
  const StudyValue* profile = document.root.find_path(table + ".profile");
  return profile && profile->string() ? *profile->string() : "";
}

std::vector<KeyList> key_lists(const Document& document, bool physical) {
  const Names state{"psi", "x", "y", "x_dot", "y_dot", "phi", "phi_dot"};
  const Names race{"race_offset", "rolling", "stiction", "rolls", "ball_radius", "contact_angle", "restitution"};
  return {
      {"rotor", physical ? Names{"mass", "stiffness", "damping", "damping_ratio", "eccentricity", "unbalance",
                                 "gravity", "inertia"}
                         : Names{"eccentricity", "damping", "stiffness", "gravity", "inertia"}},
      {"balancer",
       physical ? joined({"balls", "race_radius", "ball_diameter", "mass", "ball_density", "drag", "oil_viscosity",
                          "oil_density", "channel_diameter", "contact"},
                         race)
                : joined({"balls", "mass", "drag"}, race)},
      {"speed", joined({"profile", "law"}, keys_of_profile(profile_in(document, "speed"))), every_speed_key},
      {"speed.torque",
       {"stall", "no_load_speed", "times", "values", "gain", "integral", "limit", "target", "constant", "slope",
        "until"}},
      {"speed.torque.target", joined({"profile"}, keys_of_profile(profile_in(document, "speed.torque.target"))),
       every_speed_key},
      {"release", {"speed", "time"}},
      {"initial", state},
      {"sampling", {"box", "method", "starts", "seed"}},
      {"sampling.box", {"x", "y", "x_dot", "y_dot", "phi_dot"}},
      {"numerics", {"tolerance", "horizon", "decide"}},
      {"limits", {"displacement", "force", "velocity", "settled"}},
      {"sweep", {"over", "zip"}},
      {"units", {"mass", "length", "frequency"}},
  };
}

// What people call things that have another name here.
constexpr std::array<std::array<const char*, 2>, 36> other_names{{
    {"ball_count", "balls"},
    {"number_of_balls", "balls"},
    {"n_balls", "balls"},
    {"count", "balls"},
    {"ball_mass", "mass"},
    {"ball_drag", "drag"},
    {"damping_coefficient", "drag"},
    {"viscosity", "oil_viscosity"},
    {"radius", "race_radius"},
    {"diameter", "ball_diameter"},
    {"density", "ball_density"},
    {"ball_size", "ball_diameter"},
    {"friction", "rolling"},
    {"natural_frequency", "stiffness"},
    {"critical_speed", "stiffness"},
    {"spring", "stiffness"},
    {"k", "stiffness"},
    {"m", "mass"},
    {"c", "damping"},
    {"zeta", "damping_ratio"},
    {"zeta", "damping"},
    {"damping_factor", "damping_ratio"},
    {"damping_ratio", "damping"},
    {"imbalance", "unbalance"},
    {"imbalance", "eccentricity"},
    {"unbalance", "eccentricity"},
    {"offset", "eccentricity"},
    {"moment_of_inertia", "inertia"},
    {"speed", "final"},
    {"final_speed", "final"},
    {"final", "speed"},
    {"start", "initial"},
    {"time", "duration"},
    {"free_speed", "no_load_speed"},
    {"stall_torque", "stall"},
    {"balls", "balancer"},
}};

bool holds(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The longer name has the shorter one at an end: "race_radius_mm", "support_stiffness".
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

// The known name that was meant, or none.
std::string meant(std::string_view key, const Names& known) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edit_distance(key.substr(0, longest_shown), a) < edit_distance(key.substr(0, longest_shown), b);
  });
  if (nearest != known.end() && nearly_same(key, *nearest)) return *nearest;
  for (const auto& [said, name] : other_names)
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

void check_keys(const Document& document, bool physical) {
  const std::vector<KeyList> lists = key_lists(document, physical);
  for (const KeyList& list : lists) {
    const StudyValue* table = document.root.find_path(list.table);
    if (!table || !table->table()) continue;
    for (const auto& entry : *table->table()) {
      const std::string& name = entry.key;
      const StudyValue& value = entry.value;
      if (holds(list.keys, name) || holds(list.elsewhere, name)) continue;
      const std::string dotted = list.table + "." + name;
      std::string problem = unknown_key(list.table, name, list.keys);
      const auto home = std::find_if(lists.begin(), lists.end(), [&](const KeyList& l) { return holds(l.keys, name); });
      if (home != lists.end() && problem.find("did you mean") == std::string::npos)
        problem += fmt::format("; [{}] has a key of this name", home->table);
      throw InputError(document.where(dotted, &value), list.table + "." + printable(name),
                       document.value_text(dotted, value), problem);
    }
  }
}

}  // namespace equipoise::study
