// Ramp functions, motors by the keys that are there, loads.
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/reading/machine_reader.hpp"
#include "equipoise/study/words/machine.hpp"

namespace equipoise::study {

namespace {

void read_ramp(TableReader& reader, const char* table, Study& study) {
  const RampSetting& ramp = study.speed;
  for (const Key& key : key_table(table).of(variant_of(ramp.profile), reader.physical()))
    if (key.name != std::string_view("duration") || !study.states("speed.run_up")) read_key(reader, key, study);
  if (ramp.profile == Profile::hill && study.speed.law != model::SpeedLaw::kinematic)
    reader.fail("law", words::machine::law_of_hill);
}

void read_target(const StudyFile& file, RampSetting& target) {
  TableReader reader(file, "speed.torque.target");
  Study study;
  study.speed.profile = reader.choice<Profile>("profile", std::span(profile_names).first(target_profiles));
  read_ramp(reader, "speed.torque.target", study);
  reader.finish();
  target = study.speed;
}

// Of a motor that is stated by its nameplate; whether it is.
bool read_nameplate(const StudyFile& file, Study& study) {
  TableReader reader(file, "speed.torque");
  const KeyTable& keys = key_table("speed.torque");
  if (!reader.has("power") && !reader.has("rated_torque")) {
    for (const char* key : {"rated_speed", "breakdown_ratio", "locked_rotor_ratio", "synchronous_speed"})
      if (reader.has(key)) reader.fail(key, words::machine::belongs_to_nameplate);
    return false;
  }
  for (const char* key : {"speeds", "values", "times", "stall", "no_load_speed", "constant", "slope", "gain", "target"})
    if (reader.has(key)) reader.fail(key, words::machine::nameplate_or_torque);
  if (!reader.has("breakdown_ratio")) reader.fail("breakdown_ratio", words::machine::breakdown_ratio_missing);
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
  read_keys(reader, "speed.torque", variants_of(motor), study);
  if (motor.kind == Kind::control) {
    if (!reader.has("target")) reader.fail("target", words::machine::target_missing);
    read_target(file, motor.target);
  }
  reader.finish();
}

void read_load(const StudyFile& file, Study& study) {
  TableReader reader(file, "speed.load");
  read_keys(reader, "speed.load", all_variants, study);
  reader.finish();
}

// What a data sheet may state besides.
void check_sheet(const StudyFile& file, const RampSetting& ramp) {
  TableReader reader(file, "speed");
  if (reader.has("run_up")) {
    if (ramp.profile != Profile::ramp) reader.fail("run_up", words::machine::profile_or_run_up);
    if (reader.has("duration")) reader.fail("run_up", words::machine::run_up_or_duration);
  }
  for (const char* key : {"gear_ratio", "motor_inertia"})
    if (reader.has(key) && !reader.has("torque")) reader.fail(key, words::machine::belongs_to_motor);
}

}  // namespace

void read_speed(const StudyFile& file, Study& study) {
  TableReader reader(file, "speed");
  read_key(reader, *key_table("speed").find("profile", false), study);
  if (file.physical) check_sheet(file, study.speed);
  read_ramp(reader, "speed", study);
  if (study.speed.driven()) {
    if (!reader.has("torque")) reader.fail("torque", words::machine::torque_missing);
    read_torque(file, study);
    if (reader.has("load")) read_load(file, study);
    if (study.speed.law != model::SpeedLaw::kinematic) reader.fail("law", words::machine::law_of_driven_rotor);
  }
  reader.finish();
}

}  // namespace equipoise::study
