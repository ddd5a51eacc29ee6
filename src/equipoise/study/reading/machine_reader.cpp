// [rotor], [[place]], [balancer] and [speed], of both forms of studies.
#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/machine/datasheet/materials.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/reading/machine_sheet.hpp"
#include "equipoise/study/reading/rules.hpp"

namespace equipoise::study {

namespace {

// Reads each table of the array of tables at a key into an entry of its own.
template <class Entry>
void read_array(const StudyFile& file, const char* key, const char* wanted, std::vector<Entry>& entries, Study& study) {
  const StudyValue* value = file.root.find_path(key);
  if (!value) return;
  const StudyValue::Array* array = value->array();
  const auto is_table = [](const StudyValue& entry) { return entry.table() != nullptr; };
  if (!array || array->empty() || !std::all_of(array->begin(), array->end(), is_table))
    throw InputError(file.where(key, value), key, "", wanted);
  for (std::size_t i = 1; i <= array->size(); ++i) {
    entries.emplace_back();
    read_table(file, fmt::format("{}.{}", key, i), study);
  }
}

// A grade, or the velocity that it means, "6.3 mm/s"; in m/s.
double grade_of(const TableReader& reader, const StudyValue& value) {
  const std::string* text = value.string();
  const std::string wanted = "must be a balance quality grade such as \"G 6.3\", or what it means, \"6.3 mm/s\"";
  const auto named = text ? grade_named(*text) : std::nullopt;
  const Measured measured = text ? measure(*text, {Dimension::velocity}) : Measured{};
  if (!named && (!text || !measured.problem.empty())) reader.fail("grade", wanted);
  const double grade = named ? *named * 1e-3 : measured.value;
  if (!(grade > 0.0) || !(grade < largest_si)) reader.fail("grade", wanted + ", greater than 0");
  return grade;
}

void read_grade(const StudyFile& file, Study& study) {
  if (!study.states("rotor.balance_grade")) return;
  TableReader reader(file, "rotor.balance_grade");
  study.sheet.grade = grade_of(reader, reader.require("grade", "a balance quality grade such as \"G 6.3\""));
  read_key(reader, *key_table("rotor.balance_grade").find("at", true), study);
  reader.finish();
}

// 12 for "12 %". Stated as a percentage a ratio may be above 1.
void refuse_percentage(const StudyFile& file, const StudyValue& given) {
  if (given.number() > 1.0) file.fail("rotor.damping_ratio", fmt::format(ratio_is_percentage, given.number()));
  if (const auto* each = given.array())
    for (const StudyValue& one : *each) refuse_percentage(file, one);
}

// Bearings are the supports: nothing else states these.
void read_bearings(const StudyFile& file, TableReader& tilt, Study& study) {
  TableReader rotor(file, "rotor");
  for (const char* key : {"stiffness", "damping", "bearings_at", "bearings_stiffness", "bearings_damping"})
    if (tilt.has(key)) tilt.fail(key, bearings_state_it);
  for (const char* first : {"rotor.stiffness", "rotor.damping"})
    for (const Key* way : ways_of(first))
      if (rotor.has(way->name)) rotor.fail(way->name, bearings_state_it);
  read_array(file, "rotor.tilt.bearings",
             "must be an array of tables, one per bearing, as [{ at = \"0.12 m\", stiffness = \"40 kN/m\", damping = "
             "\"300 N s/m\" }, ..]",
             study.sheet.bearings, study);
}

void read_tilt(const StudyFile& file, Study& study) {
  TableReader tilt(file, "rotor.tilt");
  const bool by_bearings = file.physical && tilt.has("bearings");
  if (by_bearings) read_bearings(file, tilt, study);
  for (const Key& key : key_table("rotor.tilt").of(all_variants, file.physical))
    read_key(tilt, key, study, !by_bearings && key.has(Key::replaceable));
  tilt.finish();
  if (file.physical)
    read_array(file, "rotor.tilt.unbalance",
               "must be an array of tables, one per plane, as [{ at = \"0.2 m\", size = \"50 g mm\", angle = \"0 "
               "degree\" }, ..]",
               study.sheet.unbalances, study);
}

void read_places(const StudyFile& file, Study& study) {
  read_array(file, "place", "must be an array of tables, each begun by [[place]], with mass, radius and angle",
             study.sheet.places, study);
  for (std::size_t i = 1; i <= study.sheet.places.size(); ++i) {
    TableReader place(file, fmt::format("place.{}", i));
    if (!study.parameters.tilts() && place.has("at")) place.fail("at", only_of_tilt);
    if (study.parameters.tilts()) place.require("at", wanted_of(*key_table("place").find("at", true), true).text());
  }
}

void read_oil(const StudyFile& file, Study& study) {
  TableReader(file, "balancer.oil").require("grade", "a grade such as \"ISO VG 32\" or \"silicone 1000 cSt\"");
  read_table(file, "balancer.oil", study);
}

void check_material(TableReader& reader, const std::string& name) {
  if (!reader.has("ball_material") || model::find_ball_material(name)) return;
  std::vector<std::string> names;
  for (const model::BallMaterial& known : model::ball_materials) names.emplace_back(known.name);
  reader.fail_among("ball_material", names,
                    "is not a material in the table (balancer.ball_density states any density); ");
}

bool is_of_race(std::string_view key) { return key == "balls" || key.starts_with("race"); }

}  // namespace

std::optional<double> grade_named(const std::string& text) {
  if (!text.starts_with('G')) return std::nullopt;
  return number_of_all(std::string_view(text).substr(std::min(text.find_first_not_of(' ', 1), text.size())));
}

void read_rotor(const StudyFile& file, Study& study) {
  TableReader reader(file, "rotor");
  if (reader.has("damping_ratio")) refuse_percentage(file, reader.require("damping_ratio", ""));
  read_keys(reader, "rotor", study);
  reader.finish();
  if (reader.has("tilt")) read_tilt(file, study);
  if (!file.physical) return;
  read_grade(file, study);
  read_places(file, study);
}

void read_balancer(const StudyFile& file, Study& study) {
  TableReader reader(file, "balancer");
  model::Parameters& p = study.parameters;
  for (const Key& key : key_table("balancer").of(all_variants, file.physical)) {
    const std::string_view name = key.name;
    if (p.balls == 0 && !is_of_race(name)) continue;
    if (name == "stiction") p.stiction = p.rolling;
    // Balls of known size roll, unless the study says otherwise.
    if (name == "rolls" && file.physical) p.rolls = study.states("balancer.ball_diameter");
    if (name == "ball_radius" && !p.rolls && reader.has("ball_radius"))
      reader.fail("ball_radius", "has a meaning only with balancer.rolls = true");
    read_key(reader, key, study);
  }
  if (p.balls == 0) return;
  reader.finish();
  if (file.physical) check_material(reader, study.sheet.material);
  if (file.physical && reader.has("oil")) read_oil(file, study);
  if (reader.has("plane") != p.tilts())
    reader.fail("plane", p.tilts() ? "missing; rotor.tilt needs the place of each ball's race along the shaft, a "
                                     "number, or an array, one per ball"
                                   : only_of_tilt);
}

namespace {

// Of a motor that is stated by its nameplate; whether it is.
bool read_nameplate(const StudyFile& file, Study& study) {
  TableReader reader(file, "speed.torque");
  const KeyTable& keys = key_table("speed.torque");
  if (!reader.has("power") && !reader.has("rated_torque")) {
    for (const Key& key : keys.keys)
      if (key.has(Key::physical) && reader.has(key.name))
        reader.fail(key.name, "belongs to a nameplate, which needs speed.torque.power or rated_torque");
    return false;
  }
  for (const char* key : {"speeds", "values", "times", "stall", "no_load_speed", "constant", "slope", "gain", "target"})
    if (reader.has(key))
      reader.fail(key, "give either a nameplate (speed.torque.power) or the torque itself, not both");
  if (!reader.has("breakdown_ratio"))
    reader.fail("breakdown_ratio", "missing; must be the breakdown torque over the rated torque, such as 2.5");
  study.speed.torque.kind = model::MotorLaw::Kind::curve;
  for (const Key& key : keys.keys)
    if (key.has(Key::physical)) read_key(reader, key, study, key.name == std::string_view("rated_speed"));
  reader.finish();
  return true;
}

// The keys present determine the law.
void read_torque(const StudyFile& file, Study& study) {
  using Kind = model::MotorLaw::Kind;
  if (file.physical && read_nameplate(file, study)) return;
  TableReader reader(file, "speed.torque");
  TorqueSetting& motor = study.speed.torque;
  if (reader.has("stall") || reader.has("no_load_speed"))
    motor.by_stall = true;
  else if (reader.has("speeds"))
    motor.kind = Kind::curve;
  else if (reader.has("times") || reader.has("values"))
    motor.kind = Kind::table;
  else if (reader.has("gain") || reader.has("integral") || reader.has("target"))
    motor.kind = Kind::control;
  read_keys(reader, "speed.torque", study);
  if (motor.kind == Kind::control) {
    if (!reader.has("target")) reader.fail("target", "missing; must be a table like { profile = \"ramp\", ... }");
    constexpr char target[] = "speed.torque.target";
    const auto profiles = std::span(profile_names).first(target_profiles);
    motor.target.profile = TableReader(file, target).choice<Profile>("profile", profiles);
    read_table(file, target, study);
  }
  reader.finish();
}

// What else a data sheet may state.
void check_sheet(const StudyFile& file, const RampSetting& ramp) {
  TableReader reader(file, "speed");
  if (reader.has("run_up")) {
    if (ramp.profile != Profile::ramp)
      reader.fail("run_up", "give either speed.profile or speed.run_up, not both: run_up is a ramp to speed.final");
    if (reader.has("duration")) reader.fail("run_up", "give either speed.run_up or speed.duration, not both");
  }
  for (const char* key : {"gear_ratio", "motor_inertia"})
    if (reader.has(key) && !reader.has("torque")) reader.fail(key, "belongs to a motor: needs speed.torque");
}

}  // namespace

void read_speed(const StudyFile& file, Study& study) {
  TableReader reader(file, "speed");
  read_key(reader, *key_table("speed").find("profile", false), study);
  if (file.physical) check_sheet(file, study.speed);
  for (const Key& key : key_table("speed").of(variants_in(study, "speed"), file.physical))
    if (key.name != std::string_view("duration") || !study.states("speed.run_up")) read_key(reader, key, study);
  if (study.speed.profile == Profile::hill && study.speed.law != model::SpeedLaw::kinematic)
    reader.fail("law", "must be \"kinematic\": the rotor turns at the speed that a Hill function states");
  if (study.speed.driven()) {
    if (!reader.has("torque")) reader.fail("torque", "missing; must be a table, as { constant = 0.12, slope = -0.04 }");
    read_torque(file, study);
    if (reader.has("load")) read_table(file, "speed.load", study);
    if (study.speed.law != model::SpeedLaw::kinematic)
      reader.fail("law", "must be \"kinematic\": the speed of a driven rotor follows from its motor");
  }
  reader.finish();
}

}  // namespace equipoise::study
