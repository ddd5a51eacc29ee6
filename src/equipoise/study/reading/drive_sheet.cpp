// Run-up times, nameplates and gears.
#include "equipoise/study/reading/drive_sheet.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/typed_numbers.hpp"
#include "equipoise/machine/drives/nameplate.hpp"
#include "equipoise/study/reading/quantity_reader.hpp"
#include "equipoise/study/words/machine.hpp"

namespace equipoise::study {

namespace {

constexpr double to_rpm = 30.0 / pi;

std::string profile_name(Profile profile) { return profile_names[static_cast<std::size_t>(profile)]; }

StudyValue in_si(double value, Dimension dimension) { return fmt::format("{} {}", value, words(dimension).si); }

// A key that stands for another one: its value and place are those of messages about the other.
void put_for(StudyFile& file, const std::string& table, const std::string& from, const std::string& key,
             StudyValue value) {
  StudyValue& home = *file.root.find_path(table);
  const StudyValue* source = home.find(from);
  const std::string dotted = table + "." + from;
  file.written.insert_or_assign(table + "." + key,
                                StudyFile::Written{file.value_text(dotted, *source), file.where(dotted, source)});
  home.set(key, std::move(value));
}

void put_run_up(StudyFile& file) {
  QuantityReader reader(file, "speed");
  if (!reader.has("run_up")) return;
  const StudyValue* profile = file.root.find_path("speed.profile");
  if (!profile || !profile->string() || *profile->string() != profile_name(Profile::ramp))
    reader.fail("run_up", words::machine::profile_or_run_up);
  if (reader.has("duration")) reader.fail("run_up", words::machine::run_up_or_duration);
  put_for(file, "speed", "run_up", "duration", in_si(reader.quantity("run_up"), Dimension::time));
  file.root.find("speed")->erase("run_up");
}

double synchronous_speed(QuantityReader& reader, double rated) {
  if (const auto stated = reader.optional_quantity("synchronous_speed")) {
    if (!(*stated > rated)) reader.fail("synchronous_speed", words::machine::synchronous_above_rated);
    return *stated;
  }
  const std::vector<double> fitting = model::synchronous_speeds(rated);
  if (fitting.size() == 1) return fitting.front();
  std::vector<std::string> texts;
  for (const double speed : fitting) texts.push_back(fmt::format("\"{:.5g} rpm\"", speed * to_rpm));
  reader.fail("rated_speed", texts.empty()
                                 ? words::machine::no_synchronous_speed_fits
                                 : fmt::format(words::machine::several_synchronous_speeds, fmt::join(texts, ", ")));
}

// The curve that a nameplate stands for.
void put_nameplate(StudyFile& file) {
  StudyValue* torque = find_table(file.root, "speed.torque");
  if (!torque) return;
  QuantityReader reader(file, "speed.torque");
  const auto power = reader.optional_quantity("power"), stated = reader.optional_quantity("rated_torque");
  if (!power && !stated) {
    for (const char* key : {"rated_speed", "breakdown_ratio", "locked_rotor_ratio", "synchronous_speed"})
      if (reader.has(key)) reader.fail(key, words::machine::belongs_to_nameplate);
    return;
  }
  for (const char* key : {"speeds", "values", "times", "stall", "no_load_speed", "constant", "slope", "gain", "target"})
    if (reader.has(key)) reader.fail(key, words::machine::nameplate_or_torque);
  const auto plain = [&](const char* key) {
    return reader.optional_number(key, key_table("speed.torque").find(key, true)->range);
  };
  model::Nameplate motor;
  motor.rated_speed = reader.quantity("rated_speed");
  motor.synchronous_speed = synchronous_speed(reader, motor.rated_speed);
  motor.rated_torque = stated ? *stated : *power / motor.rated_speed;
  // Catalogues round: a tenth apart is another motor.
  if (power && stated && std::fabs(*stated * motor.rated_speed / *power - 1.0) > 0.1)
    reader.fail("rated_torque", fmt::format(words::machine::torque_contradicts_power, *power / motor.rated_speed));
  if (const auto ratio = plain("breakdown_ratio"))
    motor.breakdown_ratio = *ratio;
  else
    reader.fail("breakdown_ratio", words::machine::breakdown_ratio_missing);
  motor.locked_rotor_ratio = plain("locked_rotor_ratio");
  if (motor.locked_rotor_ratio && !at_most(*motor.locked_rotor_ratio, motor.breakdown_ratio))
    reader.fail("locked_rotor_ratio", fmt::format(words::machine::above_breakdown, motor.breakdown_ratio));
  const double top = model::breakdown_slip(motor);
  if (motor.locked_rotor_ratio && top >= 1.0)
    reader.fail("locked_rotor_ratio", words::machine::no_such_locked_rotor_ratio);
  const model::CurvePoints curve = model::nameplate_curve(motor);
  StudyValue::Array speeds, values;
  for (std::size_t k = 0; k < curve.speeds.size(); ++k) {
    speeds.push_back(in_si(curve.speeds[k], Dimension::speed));
    values.push_back(in_si(curve.torques[k], Dimension::torque));
  }
  const char* from = power ? "power" : "rated_torque";
  put_for(file, "speed.torque", from, "speeds", std::move(speeds));
  put_for(file, "speed.torque", from, "values", std::move(values));
  for (const char* key :
       {"power", "rated_torque", "rated_speed", "breakdown_ratio", "locked_rotor_ratio", "synchronous_speed"})
    torque->erase(key);
}

}  // namespace

void infer_profile(StudyFile& file) {
  StudyValue* speed = find_table(file.root, "speed");
  if (!speed || speed->find("profile")) return;
  const auto state = [&](Profile profile) { speed->set("profile", profile_name(profile)); };
  if (find_table(file.root, "speed.torque"))
    state(Profile::torque);
  else if (speed->find("run_up"))
    state(Profile::ramp);
  else if (speed->find("speed"))
    state(Profile::constant);
}

double gear_factor(Dimension dimension, double ratio) {
  switch (dimension) {
    case Dimension::speed:
      return 1.0 / ratio;
    case Dimension::torque:
      return ratio;
    case Dimension::gain:
      return ratio * ratio;
    default:
      return 1.0;
  }
}

DriveSheet put_drive_sheet(StudyFile& file) {
  put_run_up(file);
  put_nameplate(file);
  StudyValue* speed = find_table(file.root, "speed");
  if (!speed) return {};
  QuantityReader reader(file, "speed");
  const Range range = key_table("speed").find("gear_ratio", true)->range;
  const double ratio = reader.optional_number("gear_ratio", range).value_or(1.0);
  const double inertia = reader.optional_quantity("motor_inertia").value_or(0.0);
  for (const char* key : {"gear_ratio", "motor_inertia"}) {
    if (reader.has(key) && !speed->find("torque")) reader.fail(key, words::machine::belongs_to_motor);
    speed->erase(key);
  }
  return {ratio, ratio * ratio * inertia};
}

}  // namespace equipoise::study
