// The table of keys, key by key: messages, suggestions, echo and units follow from it, and the guide's tables match it.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "../support/snapshots.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace study_keys_test {

using study::Key;
using study::KeyTable;

// A study of every profile and every law of motors, which has every key of a dimensionless study somewhere.
std::vector<std::string> studies() {
  const std::string free = rotor_and_balancer + "rolls = true\n[release]\ntime = 0.0\n[speed]\nprofile = ";
  const std::string motor = free + "\"torque\"\n[speed.torque]\n";
  const std::string with_units =
      "[units]\nmass = 12.0\nlength = 0.1\nfrequency = 60.0\n[standards]\nstanding_mass = 2.0\nfriction = "
      "0.3\n[sampling.box]\nx = [0.0, 0.1]\n";
  return {
      with_units + free + "\"constant\"\nspeed = 2.4\n",
      free + "\"ramp\"\nfinal = 2.4\nduration = 500.0\n",
      free + "\"trapezoid\"\npeak = 3.0\nfinal = 2.0\nrise_until = 50.0\nhold_until = 400.0\nfall_until = 500.0\n",
      free + "\"hill\"\nfinal = 2.4\nhalf_time = 50.0\nexponent = 3.0\nuntil = 400.0\n",
      free + "\"points\"\ntimes = [0.0, 10.0]\nspeeds = [1.0, 3.0]\n",
      motor + "stall = 0.1\nno_load_speed = 2.4\n",
      motor + "speeds = [0.0, 3.0]\nvalues = [0.1, 0.0]\n[speed.load]\nconstant = 0.001\nlinear = 0.001\nat = 2.0\n",
      motor + "times = [0.0, 10.0]\nvalues = [0.1, 0.0]\n",
      motor + "constant = 0.1\nslope = -0.04\n",
      motor + "gain = 0.1\ntarget = { profile = \"ramp\", final = 2.4, duration = 100.0 }\n",
      rotor_and_balancer +
          "plane = 1.0\n[rotor.tilt]\ntransverse_inertia = 3.0\npolar_inertia = 0.5\nstiffness = [0.0, 9.0]\ndamping = "
          "[0.0, 4.5]\nbearings_at = [3.0, -3.0]\nbearings_stiffness = [0.5, 0.5]\nbearings_damping = [0.25, 0.25]\n"
          "[release]\ntime = 0.0\n[speed]\nprofile = \"constant\"\nspeed = 2.4\n"};
}

// Keys that only a tilting rotor has; of its study these alone are visited.
bool is_of_tilt(const KeyTable& table, const Key& key) {
  const std::string name = key.name;
  return table.name == "rotor.tilt" || name == "eccentricity_angle" || name == "plane" || name.starts_with("tilt_");
}

Study read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> all{"rotor.inertia=0.5"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return parse_study(text, "study", all);
}

// Calls `visit` with every dimensionless key and the studies that have it.
template <class Visit>
void for_each_key(Visit&& visit) {
  for (const std::string& text : studies()) {
    const Study base = read(text);
    for (const KeyTable& table : study::key_tables()) {
      if (table.name == "units" && !base.scales) continue;
      if (table.name.starts_with("speed.") && !base.speed.driven()) continue;
      if (table.name == "speed.torque.target" && base.speed.torque.kind != model::MotorLaw::Kind::control) continue;
      for (const Key& key : table.of(study::variants_in(base, table.name), false))
        if (is_of_tilt(table, key) == base.parameters.tilts()) visit(text, base, table, key);
    }
  }
}

std::string dotted(const KeyTable& table, const Key& key) { return table.name + "." + key.name; }
bool is_table(const Key& key) {
  Study any;
  any.scales.emplace();
  return std::holds_alternative<std::monostate>(key.member(any));
}

TEST(StudyKeys, EachSaysWhatItMayBe) {
  for_each_key([](const std::string& text, const Study&, const KeyTable& table, const Key& key) {
    if (is_table(key)) return;
    try {
      read(text, {dotted(table, key) + "=\"?\""});
      ADD_FAILURE() << dotted(table, key) << " takes a word";
    } catch (const InputError& e) {
      EXPECT_EQ(e.key(), dotted(table, key)) << e.what();
      EXPECT_NE(e.problem().find("must be"), std::string::npos) << e.what();
    }
  });
}

TEST(StudyKeys, EachIsMeantByItsMisspelling) {
  for_each_key([](const std::string& text, const Study&, const KeyTable& table, const Key& key) {
    const std::string name = key.name;
    if (name.size() < 5 || name == "tilt_y") return;  // without its last letter tilt_y is as near to tilt_x
    try {
      read(text, {table.name + "." + name.substr(0, name.size() - 1) + "=1"});
    } catch (const InputError& e) {
      EXPECT_NE(e.problem().find("did you mean \"" + name + "\"?"), std::string::npos) << e.what();
    }
  });
}

// For numbers: values at both ends of the range and inside it, except those that other keys forbid.
TEST(StudyKeys, EachIsEchoedAsItWasRead) {
  std::map<std::string, int> taken;
  for_each_key([&](const std::string& text, const Study&, const KeyTable& table, const Key& key) {
    if (table.name == "speed.torque.target" || table.name == "sweep") return;
    for (const char* value :
         {"0.25", "3", "true", "[0.25, 0.75]", "\"sobol\"", "\"proof\"", "\"published\"", "\"II\"", "450", "600", "2.4",
          "1e-6", "0", "[0, 5]", "[0, 9]", "[0, 4.5]", "[3, -3]", "[0.5, 0.5]", "[0.25, 0.25]"}) {
      Study study;
      try {
        const std::string given = key.name + std::string(" = ") + value;
        std::vector<std::string> set{table.name == "release" ? "release={" + given + "}" : table.name + "." + given};
        if (key.name == std::string("settling_time")) set.push_back("limits.settled=0.1");  // it needs that one
        study = read(text, set);
      } catch (const InputError&) {
        continue;
      }
      ++taken[dotted(table, key)];
      const Study again = parse_study(to_toml(study), "echo");
      EXPECT_EQ(to_toml(again), to_toml(study));
      const auto there = study::value_of(key, study), back = study::value_of(key, again);
      ASSERT_TRUE(there && back) << dotted(table, key);
      EXPECT_EQ(to_toml(StudyValue{{"t", {{"v", *there}}}}), to_toml(StudyValue{{"t", {{"v", *back}}}}));
    }
    const bool asked = !is_table(key) && std::string(key.name) != "profile";
    EXPECT_TRUE(!asked || taken[dotted(table, key)]) << dotted(table, key) << " takes none of the values";
  });
}

TEST(StudyKeys, QuantitiesAreOfTheirDimension) {
  const std::string machine = machine_rotor + "[speed]\nprofile = \"constant\"\nspeed = \"900 rpm\"\n";
  for (const KeyTable& table : study::key_tables())
    for (const Key& key : table.of(study::all_variants, true)) {
      if (!key.dimension || table.name.starts_with("speed")) continue;
      try {
        parse_study(machine, "machine", {dotted(table, key) + "=0.25"});
        EXPECT_EQ(*key.dimension, study::Dimension::angle) << dotted(table, key);
      } catch (const InputError& e) {
        if (e.problem().find("a plain number") == std::string::npos) continue;  // another key is in the way
        EXPECT_NE(e.problem().find(study::words(*key.dimension).example), std::string::npos) << e.what();
      }
    }
}

// The guide's tables.

std::string range_words(const Key& key, const study::Member& member) {
  if (std::holds_alternative<std::monostate>(member)) return "";
  if (std::holds_alternative<bool*>(member)) return "`true`, `false`";
  if (std::holds_alternative<std::vector<std::string>*>(member)) return "texts";
  if (std::holds_alternative<Profile*>(member)) return fmt::format("`{}`", fmt::join(profile_names, "`, `"));
  if (std::holds_alternative<model::SpeedLaw*>(member)) return fmt::format("`{}`", fmt::join(speed_law_names, "`, `"));
  if (std::holds_alternative<ClassificationMode*>(member))
    return fmt::format("`{}`", fmt::join(classification_mode_names, "`, `"));
  if (std::holds_alternative<std::optional<SamplingMethod>*>(member))
    return fmt::format("`{}`", fmt::join(sampling_method_names, "`, `"));
  if (std::holds_alternative<std::optional<SeverityClassName>*>(member))
    return fmt::format("`{}`", fmt::join(severity_class_names, "`, `"));
  const study::Range& r = key.range;
  const std::string high = r.high == two_pi ? "2 pi" : fmt::format("{}", r.high);
  std::string words = r.low < 0.0                 ? "finite"
                      : r.high < study::unbounded ? fmt::format("{} to {}{}", r.low, r.high_open ? "below " : "", high)
                      : r.low_open                ? "greater than 0"
                                                  : "0 or more";
  if (r.high == 0x1p63) words = "0 or more";
  if (std::holds_alternative<std::vector<double>*>(member)) words += ", a list";
  if (std::holds_alternative<std::optional<SamplingBox::Side>*>(member)) words += ", `[low, high]`";
  if (std::holds_alternative<std::array<double, 2>*>(member))
    words += key.has(Key::pair) ? ", `[x, y]`" : "; or `[x, y]`";
  if (std::holds_alternative<std::array<double, model::max_balls>*>(member)) words += "; or one per ball";
  return words;
}

std::string default_words(const Key& key, const Study& defaults) {
  if (key.required_in(false)) return "required";
  const auto value = study::value_of(key, defaults);
  if (!value || std::string(key.sentence).find("default") != std::string::npos) return "";
  if (value->string()) return fmt::format("`{}`", *value->string());
  if (value->array()) return fmt::format("{}", value->array()->empty() ? 0.0 : value->array()->front().number());
  return value->boolean() ? (*value->boolean() ? "`true`" : "`false`") : fmt::format("{}", value->number());
}

// "`ramp`, `trapezoid`: ": the variants of [speed] that have the key.
std::string profiles_of(const KeyTable& table, const Key& key) {
  std::string names;
  for (std::size_t k = 0; table.name == "speed" && k < profile_names.size(); ++k)
    if (key.variants() & study::variant_of(static_cast<Profile>(k)))
      names += fmt::format("{}`{}`", names.empty() ? "" : ", ", profile_names[k]);
  return names.empty() ? "" : names + ": ";
}

std::string guide_table(const KeyTable& table, bool physical) {
  Study defaults;
  defaults.scales.emplace();
  const bool quantities =
      !physical && !study::is_machine(table.name) &&
      std::any_of(table.keys.begin(), table.keys.end(), [](const Key& key) { return key.dimension.has_value(); });
  std::string text = physical     ? "| key | quantity, such as | meaning |\n|---|---|---|\n"
                     : quantities ? "| key | meaning | range | default | in physical units |\n|---|---|---|---|---|\n"
                                  : "| key | meaning | range | default |\n|---|---|---|---|\n";
  for (const Key& key : table.keys) {
    if (!key.in_form(physical) || (physical && !study::is_machine(table.name) && !key.has(Key::physical))) continue;
    const auto quantity = [](const study::DimensionWords& w) { return fmt::format("{}, `\"{}\"`", w.name, w.example); };
    const std::string example = key.dimension ? quantity(study::words(*key.dimension)) : "";
    const std::string meaning = profiles_of(table, key) + key.meaning(physical);
    text += physical
                ? fmt::format("| `{}` | {} | {}{} |\n", key.name, example, meaning,
                              key.required_in(true) ? "; required" : "")
                : fmt::format("| `{}` | {} | {} | {} |{}\n", key.name, meaning, range_words(key, key.member(defaults)),
                              default_words(key, defaults), quantities ? fmt::format(" {} |", example) : "");
  }
  return text;
}

// A machine's tables have other keys in physical studies; what such studies have in addition to in other tables is
// listed alone.
bool has_physical_keys(const KeyTable& table) {
  return std::any_of(table.keys.begin(), table.keys.end(), [](const Key& key) { return key.has(Key::physical); });
}

TEST(StudyKeys, StandInTheGuide) {
  std::map<std::string, std::string> tables;
  for (const KeyTable& table : study::key_tables())
    for (const bool physical : {false, true})
      if (!table.of(study::all_variants, physical).empty() && table.name != "speed.torque.target" &&
          (!physical || has_physical_keys(table)))
        tables["keys of " + table.name + (physical ? ", physical" : "")] = guide_table(table, physical);
  expect_in_docs("reference/study-file.md", tables);
}

}  // namespace study_keys_test
}  // namespace equipoise
