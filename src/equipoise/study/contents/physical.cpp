// From a machine in physical units to the dimensionless study (docs/explanation/equations.md, "Units").
#include "equipoise/study/contents/physical.hpp"

#include <array>
#include <complex>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "equipoise/study/reading/drive_sheet.hpp"
#include "equipoise/study/reading/machine_sheet.hpp"
#include "equipoise/study/reading/quantity_reader.hpp"
#include "equipoise/study/words/study.hpp"

namespace equipoise::study {

namespace {

std::vector<double> over(std::vector<double> values, double scale) {
  for (double& v : values) v /= scale;
  return values;
}

// Keeps what the study says of a key that is to be replaced.
void keep_written(StudyFile& file, const StudyValue& table, const std::string& prefix, const std::string& key,
                  const std::string& physical_key) {
  if (const StudyValue* source = table.find(physical_key)) {
    const std::string from = prefix + "." + physical_key;
    file.written.insert_or_assign(prefix + "." + key,
                                  StudyFile::Written{file.value_text(from, *source), file.where(from, source)});
  }
}

// Replaces one physical key's value by numbers.
void put(StudyFile& file, StudyValue& table, const std::string& prefix, const Derived& d, bool as_array) {
  keep_written(file, table, prefix, d.key, d.from);
  if (as_array)
    table.set(d.key, d.values);
  else
    table.set(d.key, d.values.front());
}

// Whether no dimensionless study has the key.
bool physical_alone(const KeyTable& table, const Key& key) {
  return key.has(Key::physical) && !table.find(key.name, false);
}

// Puts the `derived` keys, divided by their scales, into a table, and removes purely physical keys.
void replace(StudyFile& file, const std::string& name, std::vector<Derived> derived, const model::Scales& s) {
  StudyValue& table = *file.root.find_path(name);
  for (Derived& d : derived) {
    if (d.dimension) d.values = over(d.values, scale_of(*d.dimension, s));
    put(file, table, name, d, d.is_list || d.values.size() > 1);
  }
  for (const Key& key : key_table(name).keys)
    if (physical_alone(key_table(name), key)) table.erase(key.name);
}

StudyValue support_value(const std::array<std::array<double, 2>, 2>& each, double across, double own) {
  StudyValue value;
  for (const std::size_t d : {0, 1})
    value.set(d == 0 ? "x" : "y", std::vector<double>{each[d][0] / across, each[d][1] / own});
  return each[0] == each[1] ? *value.find("x") : value;
}

// `motor`: the motor's inertia at the rotor, which adds to what the rotor's is by default.
void replace_tilt(StudyFile& file, const RotorSheet& rotor, double motor, const model::Scales& s) {
  if (!rotor.supports) return;
  const std::string name = "rotor.tilt";
  const TiltSupports& supports = *rotor.supports;
  StudyValue& table = *file.root.find_path(name);
  keep_written(file, table, name, "stiffness", supports.stiffness_from);
  keep_written(file, table, name, "damping", supports.damping_from);
  table.set("stiffness", support_value(supports.stiffness, scale_of(Dimension::force, s), s.torque()));
  table.set("damping", support_value(supports.damping, scale_of(Dimension::tilt_damping, s), s.gain()));
  replace(file, name, rotor.tilt, s);
  if (motor == 0.0 || file.root.find_path("rotor.inertia")) return;
  model::Tilt body;
  for (const auto& [key, member] :
       {std::pair{"transverse_inertia", &body.transverse_inertia}, std::pair{"polar_inertia", &body.polar_inertia},
        std::pair{"misalignment", &body.misalignment}})
    if (const StudyValue* value = table.find(key)) *member = value->number();
  file.root.find("rotor")->set("inertia", model::axial_inertia(body));
}

// From the axes of the machine to those of the model, whose x points along the unbalance.
void turn_back(std::vector<double>& offset, double turn) {
  if (turn == 0.0) return;
  const std::complex<double> turned = std::complex<double>(offset[0], offset[1]) * std::polar(1.0, -turn);
  offset = {turned.real(), turned.imag()};
}

void replace_balancer(StudyFile& file, const BalancerSheet& b, double turn, const model::Scales& s) {
  std::vector<double> mu, beta;
  for (std::size_t i = 0; i < b.mass.size(); ++i) {
    mu.push_back(b.mass[i] / s.mass);
    beta.push_back(b.drag_torque[i] / s.ball_drag(b.mass[i]));
  }
  std::vector<Derived> derived{{"mass", b.mass_from, mu}, {"drag", b.drag_from, beta}};
  for (auto [key, values] : b.others) {
    if (key == "race_offset") turn_back(values, turn);
    derived.push_back({key, key, values, find_quantity("balancer", key)->dimension});
  }
  if (b.contact_angle) derived.push_back({"contact_angle", b.contact_from, {*b.contact_angle}});
  if (b.rolls) {
    file.root.find("balancer")->set("rolls", true);
    derived.push_back({"ball_radius", b.rolls_from, b.radius_of_balls, Dimension::length});
  }
  replace(file, "balancer", derived, s);
}

void replace_quantities(StudyFile& file, const KeyTable& keys, const model::Scales& s, double gear_ratio) {
  StudyValue* table = find_table(file.root, keys.name);
  if (!table) return;  // absent, or not a table: the study reader says so
  TableReader reader(file, keys.name);
  for (const Key& line : keys.keys) {
    if (!line.dimension) continue;
    const std::string key = line.name;
    const Range range = quantity_range(line);
    const StudyValue* value = table->find(key);
    if (!value) continue;
    const double scale = scale_of(*line.dimension, s);
    const double factor = keys.name.starts_with("speed.torque") ? gear_factor(*line.dimension, gear_ratio) : 1.0;
    Derived derived{key, key, {}};
    const StudyValue::Array* array = value->array();
    if (!array) {
      const auto reject = [&](const std::string& problem) { reader.fail(key, problem); };
      derived.values.push_back(measure_value(*value, {*line.dimension}, range, reject).value * factor / scale);
    } else {
      for (const StudyValue& entry : *array) {
        const auto reject = [&](const std::string& problem) {
          reader.fail(key, fmt::format("entry {} {}", derived.values.size() + 1, problem));
        };
        derived.values.push_back(measure_value(entry, {*line.dimension}, range, reject).value * factor / scale);
      }
    }
    put(file, *table, keys.name, derived, array != nullptr);
  }
}

// The first purely physical key; empty if there is none.
std::string physical_key(const StudyFile& file) {
  for (const KeyTable& table : key_tables())
    for (const Key& key : table.keys)
      if (const std::string dotted = table.name + "." + key.name;
          physical_alone(table, key) && file.root.find_path(dotted))
        return dotted;
  if (file.root.find("place")) return "place";
  return "";
}

// Without a mass nothing has a scale. The message names the key that makes the study physical: it may be a mistake.
void require_mass(const StudyFile& file) {
  const std::string key = physical_key(file);
  if (key == "rotor.mass") return;
  throw InputError(
      file.where("rotor.mass", nullptr), "rotor.mass", "",
      fmt::format(words::study::mass_makes_it_physical, wanted_quantity({Dimension::mass}, positive), key));
}

void check_horizon(const StudyFile& file, const model::Scales& s) {
  TableReader numerics(file, "numerics");
  if (!numerics.has("horizon")) return;
  const double horizon = numerics.number("horizon", any_number);
  const Range horizon_range = key_table("numerics").find("horizon", false)->range;
  if (!horizon_range.contains(horizon))
    numerics.fail("horizon", fmt::format(words::study::horizon, horizon_range.low * s.time(),
                                         horizon_range.high * s.time(), horizon_range.low, horizon_range.high));
}

}  // namespace

bool is_physical(const StudyFile& file) { return !physical_key(file).empty(); }

void make_dimensionless(StudyFile& file, Study& study) {
  if (!is_physical(file)) return;
  if (const StudyValue* units = file.root.find("units"))
    throw InputError(file.where("units", units), "units", "", words::study::units_of_dimensionless_study);
  require_mass(file);
  const DriveSheet drive = put_drive_sheet(file);
  const RotorSheet rotor = read_rotor_sheet(file);
  const BalancerSheet balancer = read_balancer_sheet(file);
  const model::Scales scales = model::Scales::of(rotor.mass, balancer.radius, rotor.mean_stiffness);
  replace(file, "rotor", rotor.derived, scales);
  replace_tilt(file, rotor, drive.inertia, scales);
  replace_balancer(file, balancer, rotor.turn, scales);
  if (StudyValue* inertia = file.root.find_path("rotor.inertia"); inertia && drive.inertia > 0.0)
    *inertia = inertia->number() + drive.inertia / scales.inertia();
  file.root.erase("place");
  for (const KeyTable& table : key_tables())
    if (!is_machine(table.name)) replace_quantities(file, table, scales, drive.gear_ratio);
  study.physical = true;
  study.scales = file.scales = scales;
  study.ball_details = balancer.details;
  study.direction_of_x = rotor.turn;
  check_horizon(file, scales);
}

}  // namespace equipoise::study
