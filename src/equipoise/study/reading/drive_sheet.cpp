// A motor by its nameplate.
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/typed_numbers.hpp"
#include "equipoise/machine/drives/nameplate.hpp"
#include "equipoise/study/reading/machine_sheet.hpp"
#include "equipoise/study/words/machine.hpp"

namespace equipoise::study {

namespace {

constexpr double to_rpm = 30.0 / pi;
const std::string of_motor = "speed.torque.";

double synchronous_speed(const Study& machine, const Refuse& refuse) {
  const double rated = machine.sheet.rated_speed;
  if (machine.states(of_motor + "synchronous_speed")) {
    const double stated = machine.sheet.synchronous_speed;
    if (!(stated > rated)) refuse(of_motor + "synchronous_speed", words::machine::synchronous_above_rated);
    return stated;
  }
  const std::vector<double> fitting = model::synchronous_speeds(rated);
  if (fitting.size() != 1) {
    std::vector<std::string> texts;
    for (const double speed : fitting) texts.push_back(fmt::format("\"{:.5g} rpm\"", speed * to_rpm));
    refuse(of_motor + "rated_speed",
           texts.empty() ? words::machine::no_synchronous_speed_fits
                         : fmt::format(words::machine::several_synchronous_speeds, fmt::join(texts, ", ")));
  }
  return fitting.front();
}

}  // namespace

void put_nameplate(const Study& machine, Study& study, const Refuse& refuse) {
  const DataSheet& d = machine.sheet;
  const bool power = machine.states(of_motor + "power"), stated = machine.states(of_motor + "rated_torque");
  if (!machine.speed.driven() || (!power && !stated)) return;
  model::Nameplate motor;
  motor.rated_speed = d.rated_speed;
  motor.synchronous_speed = synchronous_speed(machine, refuse);
  motor.rated_torque = stated ? d.rated_torque : d.power / motor.rated_speed;
  // Catalogues round: a tenth apart is another motor.
  if (power && stated && std::fabs(d.rated_torque * motor.rated_speed / d.power - 1.0) > 0.1)
    refuse(of_motor + "rated_torque",
           fmt::format(words::machine::torque_contradicts_power, d.power / motor.rated_speed));
  motor.breakdown_ratio = d.breakdown_ratio;
  const std::string locked = of_motor + "locked_rotor_ratio";
  if (machine.states(locked)) {
    motor.locked_rotor_ratio = d.locked_rotor_ratio;
    if (!at_most(d.locked_rotor_ratio, motor.breakdown_ratio))
      refuse(locked, fmt::format(words::machine::above_breakdown, motor.breakdown_ratio));
    if (model::breakdown_slip(motor) >= 1.0) refuse(locked, words::machine::no_such_locked_rotor_ratio);
  }
  const model::CurvePoints curve = model::nameplate_curve(motor);
  study.speed.torque.speeds = curve.speeds;
  study.speed.torque.values = curve.torques;
}

}  // namespace equipoise::study
