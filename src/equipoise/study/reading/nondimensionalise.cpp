// From a machine in SI units to the dimensionless study: quantities over their scales, and the parts of a data sheet.
#include <concepts>
#include <optional>
#include <ranges>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/reading/machine_sheet.hpp"
#include "equipoise/study/words/study.hpp"

namespace equipoise::study {

namespace {

struct Quantity {
  const KeyTable* table;
  const Key* key;
};

// The quantities that mean the same in both forms of studies, of one table or of all others but that of a target.
std::vector<Quantity> quantities(bool of_target) {
  std::vector<Quantity> all;
  for (const KeyTable& table : key_tables())
    for (const Key& key : table.keys) {
      const Key* plain = table.find(key.name, false);
      if ((table.name == "speed.torque.target") == of_target && key.in_form(true) && key.dimension && plain &&
          plain->where == key.where)
        all.push_back({&table, &key});
    }
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

void divide(Study& study, const std::vector<Quantity>& all, const Refuse& refuse) {
  const model::Scales& scales = *study.scales;
  for (const auto& [table, key] : all) {
    const double scale = scale_of(*key->dimension, scales);
    const double factor =
        table->name.starts_with("speed.torque") ? gear_factor(*key->dimension, study.sheet.gear_ratio) : 1.0;
    const Range range = range_in(study, *key);
    const auto change = [&](double& value, int place) {
      value = value * factor / scale;
      if (value == 0.0 || range.contains(value)) return;  // 0: not stated
      const std::string dotted = table->name + "." + key->name;
      if (dotted == "numerics.horizon")
        refuse(dotted, fmt::format(words::study::horizon, range.low * scales.time(), range.high * scales.time(),
                                   range.low, range.high));
      refuse(dotted, (place > 0 ? fmt::format("entry {} must be ", place) : "must be ") + range.text());
    };
    std::visit(Numbered<decltype(change)>{change}, key->member(study));
  }
}

}  // namespace

Study nondimensionalise(const Study& machine, const Refuse& refuse) {
  static const std::vector<Quantity> most = quantities(false), of_target = quantities(true);
  Study study = machine;
  put_nameplate(machine, study, refuse);
  const double stiffness = put_stiffness(machine, study, refuse);
  study.scales = model::Scales::of(machine.sheet.mass, put_race(machine, study, refuse), stiffness);
  divide(study, most, refuse);
  if (study.speed.driven() && study.speed.torque.kind == model::MotorLaw::Kind::control) {
    Study target;
    target.scales = study.scales;
    target.sheet.gear_ratio = study.sheet.gear_ratio;
    static_cast<RampSetting&>(target.speed) = study.speed.torque.target;
    divide(target, of_target, refuse);
    study.speed.torque.target = target.speed;
  }
  put_rotor(machine, study, refuse);
  put_balls(machine, study, refuse);
  return study;
}

}  // namespace equipoise::study
