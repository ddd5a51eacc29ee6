// Ramp functions, motors by the keys that are there, loads.
#include "equipoise/study/reading/speed_reader.hpp"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/reading/rules.hpp"
#include "equipoise/study/words/machine.hpp"

namespace equipoise::study {

namespace {

// Times or speeds must increase, and each needs a value.
void check_points(TableReader& reader, const char* key, const std::vector<double>& points, const char* values_key,
                  const std::vector<double>& values) {
  const bool times = key == std::string_view("times");
  for (std::size_t i = 1; i < points.size(); ++i)
    if (!(points[i] > points[i - 1]))
      reader.fail(key, fmt::format(words::machine::out_of_order, key, i + 1,
                                   times ? reader.time_text(points[i - 1]) : reader.speed_text(points[i - 1])));
  if (points.size() != values.size())
    reader.fail(values_key,
                fmt::format(words::machine::one_entry_each, values.size(), times ? "time" : "speed", points.size()));
}

void read_ramp(TableReader& reader, const char* table, Study& study) {
  const RampSetting& ramp = study.speed;
  read_keys(reader, table, variant_of(ramp.profile), study);
  if (ramp.profile == Profile::points) {
    if (ramp.times.front() != 0.0) reader.fail("times", words::machine::first_time);
    check_points(reader, "times", ramp.times, "speeds", ramp.speeds);
  }
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

// The keys present determine the law.
void read_torque(const StudyFile& file, Study& study) {
  using Kind = model::MotorLaw::Kind;
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
  if (motor.kind == Kind::table) check_points(reader, "times", motor.times, "values", motor.values);
  if (motor.kind == Kind::curve) {
    check_points(reader, "speeds", motor.speeds, "values", motor.values);
    const std::size_t points = motor.speeds.size();
    if (points < 2 || points > model::most_curve_points)
      reader.fail("speeds", fmt::format(words::machine::points_of_curve, points, model::most_curve_points));
  }
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

}  // namespace

void read_speed(const StudyFile& file, Study& study) {
  TableReader reader(file, "speed");
  read_key(reader, *key_table("speed").find("profile", false), study);
  read_ramp(reader, "speed", study);
  if (study.speed.driven()) {
    if (!reader.has("torque")) reader.fail("torque", words::machine::torque_missing);
    read_torque(file, study);
    if (reader.has("load")) read_load(file, study);
    if (study.speed.law != model::SpeedLaw::kinematic) reader.fail("law", words::machine::law_of_driven_rotor);
  }
  reader.finish();
  check_speed(study, refuse_in(file));
}

}  // namespace equipoise::study
