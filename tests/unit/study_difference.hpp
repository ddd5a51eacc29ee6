// Whether two studies ask the same, key by key; for the tests of the study reader and its fuzz target.
#pragma once

#include <optional>
#include <string>

#include "equipoise/study/keys.hpp"

namespace equipoise {

/// The first key whose value differs by so much as a bit, or empty. Not the name, nor what the profile does not use.
inline std::string first_difference(const Study& a, const Study& b) {
  if (a.speed_profile().times != b.speed_profile().times) return "the profile's times";
  if (a.speed_profile().speeds != b.speed_profile().speeds) return "the profile's speeds";
  if (a.release_time() != b.release_time()) return "release_time()";
  if (a.scales.has_value() != b.scales.has_value()) return "scales";
  const auto text = [](const std::optional<StudyValue>& value) {
    return value ? to_toml(StudyValue{{"table", {{"key", *value}}}}) : "";
  };
  for (const study::KeyTable& table : study::key_tables()) {
    if (table.name == "speed.torque.target" || (table.name == "units" && !a.scales)) continue;
    const unsigned variants = table.name == "speed"          ? study::variant_of(a.speed.profile)
                              : table.name == "speed.torque" ? study::variants_of(a.speed.torque)
                                                             : study::all_variants;
    for (const study::Key& key : table.of(variants, false))
      if (text(study::value_of(key, a)) != text(study::value_of(key, b))) return table.name + "." + key.name;
  }
  const auto &of_a = a.uncertain.values, &of_b = b.uncertain.values;
  if (of_a.size() != of_b.size()) return "uncertain";
  for (std::size_t k = 0; k < of_a.size(); ++k)
    if (of_a[k].key != of_b[k].key || of_a[k].kind != of_b[k].kind || of_a[k].numbers != of_b[k].numbers ||
        of_a[k].between != of_b[k].between || of_a[k].unit != of_b[k].unit)
      return "uncertain " + of_a[k].key;
  return "";
}

}  // namespace equipoise
