// From a machine in SI units to the dimensionless study: quantities over their scales, motors by their nameplate, and
// the other parts of a data sheet.
#include <cmath>
#include <concepts>
#include <optional>
#include <ranges>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/typed_numbers.hpp"
#include "equipoise/machine/drives/motor.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/reading/machine_sheet.hpp"

namespace equipoise::study {

namespace {

struct Quantity {
  const KeyTable* table;
  const Key* key;
};

// The quantities of both forms of studies that data sheets state in one way.
std::vector<Quantity> quantities() {
  std::vector<Quantity> all;
  for (const KeyTable& table : key_tables())
    for (const Key& key : table.keys)
      if (key.in_form(false) && key.dimension && !key.way.of) all.push_back({&table, &key});
  return all;
}

// What a quantity at the motor's shaft is multiplied by at the rotor's: speeds by 1/ratio, torques by the ratio,
// torques for a speed by its square.
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

// Calls `change` with each number of a key, and its place in a list from 1, else 0.
template <class Change>
struct Numbered {
  const Change& change;

  void operator()(double* value) const { change(*value, 0); }
  void operator()(std::optional<double>* value) const {
    if (*value) change(**value, 0);
  }
  void operator()(std::optional<SamplingBox::Side>* side) const {
    if (!*side) return;
    change((*side)->low, 1);
    change((*side)->high, 2);
  }
  template <std::ranges::range List>
  requires std::same_as < std::ranges::range_value_t<List>,
  double > void operator()(List* values) const {
    int place = 0;
    for (double& value : *values) change(value, ++place);
  }
  template <class T>
  void operator()(const T&) const {}  // no numbers
};

// Puts every quantity over its scale.
void divide(Study& study, const Refuse& refuse) {
  static const std::vector<Quantity> all = quantities();
  const model::Scales& scales = *study.scales;
  for (const Quantity& quantity : all) {
    const Key& key = *quantity.key;
    const std::string& table = quantity.table->name;
    const double scale = scale_of(*key.dimension, scales);
    const double factor = table.starts_with("speed.torque") ? gear_factor(*key.dimension, study.sheet.gear_ratio) : 1.0;
    const Range range = range_in(study, key);
    const auto change = [&](double& value, int place) {
      value = value * factor / scale;
      if (value == 0.0 || range.contains(value)) return;  // 0: not stated
      const std::string dotted = table + "." + key.name;
      if (dotted == "numerics.horizon")
        refuse(dotted, fmt::format("must be a time from {:.6g} s to {:.6g} s ({} to {} times 1/omega_c)",
                                   range.low * scales.time(), range.high * scales.time(), range.low, range.high));
      refuse(dotted, (place > 0 ? fmt::format("entry {} must be ", place) : "must be ") + range.text());
    };
    std::visit(Numbered<decltype(change)>{change}, key.member(study, entry_of(table)));
  }
}

constexpr double to_rpm = 30.0 / pi;
const std::string of_motor = "speed.torque.";

double synchronous_speed(const Sheet& s) {
  const double rated = s.given.rated_speed;
  if (s.states(of_motor + "synchronous_speed")) {
    const double stated = s.given.synchronous_speed;
    if (!(stated > rated)) s.refuse(of_motor + "synchronous_speed", "must be greater than speed.torque.rated_speed");
    return stated;
  }
  const std::vector<double> fitting = model::synchronous_speeds(rated);
  if (fitting.size() != 1) {
    std::vector<std::string> texts;
    for (const double speed : fitting) texts.push_back(fmt::format("\"{:.5g} rpm\"", speed * to_rpm));
    s.refuse(
        of_motor + "rated_speed",
        texts.empty()
            ? "is not within 10 % below a synchronous speed at 50 or 60 Hz; also give speed.torque.synchronous_speed"
            : fmt::format("fits several synchronous speeds; give speed.torque.synchronous_speed, one of {}",
                          fmt::join(texts, ", ")));
  }
  return fitting.front();
}

// The curve that a nameplate stands for, in SI units.
void put_nameplate(const Sheet& s) {
  const DataSheet& d = s.given;
  const bool power = s.states(of_motor + "power"), stated = s.states(of_motor + "rated_torque");
  if (!s.machine.speed.driven() || (!power && !stated)) return;
  model::Nameplate motor;
  motor.rated_speed = d.rated_speed;
  motor.synchronous_speed = synchronous_speed(s);
  motor.rated_torque = stated ? d.rated_torque : d.power / motor.rated_speed;
  // Catalogues round: a tenth apart is another motor.
  if (power && stated && std::fabs(d.rated_torque * motor.rated_speed / d.power - 1.0) > 0.1)
    s.refuse(of_motor + "rated_torque",
             fmt::format("contradicts speed.torque.power, which is {:.4g} N m at the rated speed",
                         d.power / motor.rated_speed));
  motor.breakdown_ratio = d.breakdown_ratio;
  const std::string locked = of_motor + "locked_rotor_ratio";
  if (s.states(locked)) {
    motor.locked_rotor_ratio = d.locked_rotor_ratio;
    if (!at_most(d.locked_rotor_ratio, motor.breakdown_ratio))
      s.refuse(locked,
               fmt::format("contradicts speed.torque.breakdown_ratio; must be at most {}", motor.breakdown_ratio));
    if (model::breakdown_slip(motor) >= 1.0)
      s.refuse(
          locked,
          "is not possible: at this rated speed and breakdown ratio the torque falls from standstill on; leave it out");
  }
  const model::CurvePoints curve = model::nameplate_curve(motor);
  s.study.speed.torque.speeds = curve.speeds;
  s.study.speed.torque.values = curve.torques;
}

}  // namespace

Study nondimensionalise(const Study& machine, const Refuse& refuse) {
  Study study = machine;
  const Sheet sheet{machine, study, refuse};
  put_nameplate(sheet);
  const double stiffness = put_stiffness(sheet);
  study.scales = model::Scales::of(machine.sheet.mass, put_race(sheet), stiffness);
  divide(study, refuse);
  put_rotor(sheet);
  put_balls(sheet);
  return study;
}

}  // namespace equipoise::study
