// From a machine in physical units to the dimensionless study (docs/equations.md, "Units").
#include "equipoise/study/physical.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/mechanics/ball_drag.hpp"
#include "equipoise/model/parameters.hpp"
#include "equipoise/study/drive_sheet.hpp"
#include "equipoise/study/quantity_reader.hpp"

namespace equipoise::study {

namespace {

using Values = std::vector<double>;

// A key of a dimensionless table: its values, the physical key behind them, and their dimension, if any.
struct Derived {
  std::string key, from;
  Values values;
  std::optional<Dimension> dimension = std::nullopt;
};

Values over(Values values, double scale) {
  for (double& v : values) v /= scale;
  return values;
}

struct Rotor {
  double mass = 0.0;            // M, kg
  double mean_stiffness = 0.0;  // k, N/m
  std::vector<Derived> derived;
};

Rotor read_rotor(const Document& document) {
  QuantityReader reader(document, "rotor");
  const std::string direction = "direction (x, y)";
  Rotor r;
  r.mass = reader.quantity("mass");
  if (!reader.has("stiffness")) reader.quantity("stiffness");  // reports what is missing
  const Values stiffness = reader.one_or_each("stiffness", 2, direction);
  r.mean_stiffness = stiffness[0] + 0.5 * (stiffness[1] - stiffness[0]);  // exact for equal stiffnesses
  const Values kappa = over(stiffness, r.mean_stiffness);
  r.derived.push_back({"stiffness", "stiffness", kappa});
  reader.exactly_one("damping", "a damping coefficient of 0 or more, such as \"200 N s/m\"", "damping_ratio",
                     "a plain number, c/(2 sqrt(k M))");
  if (reader.has("damping_ratio")) {
    const Range range = key_table("rotor").find("damping_ratio", true)->range;
    Values zeta = reader.TableReader::one_or_each("damping_ratio", range, 2, direction);
    for (std::size_t i = 0; i < 2; ++i) zeta[i] = 2.0 * zeta[i] * std::sqrt(kappa[i]);
    r.derived.push_back({"damping", "damping_ratio", zeta});
  } else {
    r.derived.push_back({"damping", "damping", reader.one_or_each("damping", 2, direction), Dimension::damping});
  }
  reader.exactly_one("eccentricity", "a length of 0 or more, such as \"0.2 mm\"", "unbalance",
                     "mass times eccentricity, such as \"300 g mm\"");
  const bool unbalance = reader.has("unbalance");
  const char* from = unbalance ? "unbalance" : "eccentricity";
  r.derived.push_back(
      {"eccentricity", from, {reader.quantity(from)}, unbalance ? Dimension::unbalance : Dimension::length});
  for (const auto& [key, values] : reader.others(0))
    r.derived.push_back({key, key, values, find_quantity("rotor", key)->dimension});
  reader.finish();
  return r;
}

struct Balancer {
  int balls = 0;
  double radius = 0.0;              // R, m
  std::vector<double> mass;         // kg
  std::vector<double> drag_torque;  // drag torque per rate relative to the race, N m s
  std::map<std::string, Values> others;
  bool rolls = false;
  std::vector<double> radius_of_balls;  // m, if they roll
  BallDetails details;
  std::optional<double> contact_angle;
  std::string mass_from, drag_from, rolls_from, contact_from;
};

class BalancerReader {
 public:
  explicit BalancerReader(const Document& document) : reader_(document, "balancer") {}

  Balancer read() {
    b_.balls = static_cast<int>(reader_.integer("balls", 1, model::max_balls));
    b_.radius = reader_.quantity("race_radius");
    diameter_ = reader_.one_or_each("ball_diameter", b_.balls, "ball");
    for (const double d : diameter_)
      if (d >= 2.0 * b_.radius) reader_.fail("ball_diameter", "must be less than twice balancer.race_radius");
    read_mass();
    read_drag();
    read_rolls();
    read_contact();
    b_.others = reader_.others(b_.balls);
    reader_.finish();
    b_.details.diameter = diameter_;
    return std::move(b_);
  }

 private:
  void need_diameter(const char* key) {
    if (diameter_.empty()) reader_.fail(key, "needs balancer.ball_diameter, such as \"8 mm\"");
  }

  void read_mass() {
    reader_.exactly_one("mass", "a mass greater than 0, such as \"5 g\"", "ball_density",
                        "with balancer.ball_diameter");
    b_.mass = reader_.one_or_each("mass", b_.balls, "ball");
    b_.mass_from = reader_.has("mass") ? "mass" : "ball_density";
    if (reader_.has("mass")) return;
    b_.mass = reader_.one_or_each("ball_density", b_.balls, "ball");
    need_diameter("ball_density");
    for (std::size_t i = 0; i < b_.mass.size(); ++i)
      b_.mass[i] *= pi / 6.0 * diameter_[i] * diameter_[i] * diameter_[i];
  }

  void read_drag() {
    reader_.exactly_one("drag",
                        "a torque for a rate, such as \"1e-6 N m s\", or a force for a velocity, such as "
                        "\"0.01 N s/m\"",
                        "oil_viscosity", "with balancer.ball_diameter");
    b_.drag_from = reader_.has("drag") ? "drag" : "oil_viscosity";
    Dimension measured{};
    b_.drag_torque = reader_.one_or_each("drag", b_.balls, "ball", Dimension::damping, &measured);
    if (!b_.drag_torque.empty() && measured == Dimension::damping)
      for (double& d : b_.drag_torque) d *= b_.radius * b_.radius;
    if (b_.drag_torque.empty())
      b_.drag_torque = drag_in_oil();
    else
      for (const char* key : {"oil_density", "channel_diameter"})
        if (reader_.has(key)) reader_.fail(key, "has a meaning only with balancer.oil_viscosity");
  }

  std::vector<double> drag_in_oil() {
    Dimension measured{};
    double viscosity =
        reader_.one_or_each("oil_viscosity", 1, "balancer", Dimension::kinematic_viscosity, &measured).front();
    const auto density = reader_.optional_quantity("oil_density");
    if (measured == Dimension::kinematic_viscosity) {
      if (!density)
        reader_.fail("oil_viscosity", "is a kinematic viscosity and needs balancer.oil_density, such as \"900 kg/m3\"");
      viscosity *= *density;
    }
    b_.details.oil_viscosity = viscosity;
    b_.details.oil_density = density;
    need_diameter("oil_viscosity");
    const auto channel = reader_.optional_quantity("channel_diameter");
    std::vector<double> drag_torque;
    for (const double d : diameter_) {
      if (channel && !(d <= model::widest_ball_in_channel * *channel))
        reader_.fail("channel_diameter",
                     fmt::format("must be at least {:.6g} mm: the wall correction holds for balls up to {} of the "
                                 "channel; in a closer fit state the drag itself",
                                 1000.0 * d / model::widest_ball_in_channel, model::widest_ball_in_channel));
      drag_torque.push_back(model::stokes_drag(viscosity, d) * (channel ? model::wall_correction(d / *channel) : 1.0) *
                            b_.radius * b_.radius);
    }
    return drag_torque;
  }

  // Balls of known size roll, unless the study says otherwise.
  void read_rolls() {
    b_.rolls = reader_.flag("rolls", !diameter_.empty());
    if (!b_.rolls) {
      if (reader_.has("ball_radius")) reader_.fail("ball_radius", "has a meaning only with balancer.rolls = true");
      return;
    }
    b_.radius_of_balls = reader_.one_or_each("ball_radius", b_.balls, "ball");
    b_.rolls_from = b_.radius_of_balls.empty() ? "ball_diameter" : "ball_radius";
    if (b_.radius_of_balls.empty()) {
      need_diameter("rolls");
      for (const double d : diameter_) b_.radius_of_balls.push_back(0.5 * d);
    } else if (!diameter_.empty()) {
      reader_.fail("ball_radius", "give either balancer.ball_radius or balancer.ball_diameter, not both");
    }
    for (const double r : b_.radius_of_balls)
      if (r >= b_.radius) reader_.fail(b_.rolls_from, "must be less than balancer.race_radius");
  }

  bool one_diameter() const {
    return std::all_of(diameter_.begin(), diameter_.end(), [&](double d) { return d == diameter_.front(); });
  }

  // Balls of known size touch; different sizes are not supported yet.
  void read_contact() {
    if (reader_.has("contact_angle")) {
      if (reader_.has("contact"))
        reader_.fail("contact", "give either balancer.contact_angle or balancer.contact, not both");
      b_.contact_angle = reader_.optional_quantity("contact_angle");
      b_.contact_from = "contact_angle";
      return;
    }
    const bool given = reader_.has("contact");
    if (!reader_.flag("contact", !diameter_.empty() && one_diameter())) return;
    need_diameter("contact");
    if (!one_diameter()) reader_.fail("contact", "needs balls of one diameter");
    if (b_.balls == 1) return;
    const double widest = 2.0 * b_.radius * std::sin(pi / b_.balls);
    if (diameter_.front() >= widest)
      reader_.fail("ball_diameter",
                   fmt::format("must be less than {:.6g} mm: {} balls that touch side by side fill the race then",
                               1000.0 * widest, b_.balls));
    b_.contact_angle = 2.0 * std::asin(0.5 * diameter_.front() / b_.radius);
    b_.contact_from = given ? "contact" : "ball_diameter";
  }

  QuantityReader reader_;
  Balancer b_;
  std::vector<double> diameter_;
};

// Replaces one physical key's value by numbers.
void put(Document& document, StudyValue& table, const std::string& prefix, const Derived& d, bool as_array) {
  if (const StudyValue* source = table.find(d.from)) {
    const std::string from = prefix + "." + d.from;
    document.written.insert_or_assign(
        prefix + "." + d.key, Document::Written{document.value_text(from, *source), document.where(from, source)});
  }
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
void replace(Document& document, const std::string& name, std::vector<Derived> derived, const model::Scales& s) {
  StudyValue& table = *document.root.find(name);
  for (Derived& d : derived) {
    if (d.dimension) d.values = over(d.values, scale_of(*d.dimension, s));
    put(document, table, name, d, d.values.size() > 1);
  }
  for (const Key& key : key_table(name).keys)
    if (physical_alone(key_table(name), key)) table.erase(key.name);
}

void replace_balancer(Document& document, const Balancer& b, const model::Scales& s) {
  std::vector<double> mu, beta;
  for (std::size_t i = 0; i < b.mass.size(); ++i) {
    mu.push_back(b.mass[i] / s.mass);
    beta.push_back(b.drag_torque[i] / s.ball_drag(b.mass[i]));
  }
  std::vector<Derived> derived{{"mass", b.mass_from, mu}, {"drag", b.drag_from, beta}};
  for (const auto& [key, values] : b.others)
    derived.push_back({key, key, values, find_quantity("balancer", key)->dimension});
  if (b.contact_angle) derived.push_back({"contact_angle", b.contact_from, {*b.contact_angle}});
  if (b.rolls) {
    document.root.find("balancer")->set("rolls", true);
    derived.push_back({"ball_radius", b.rolls_from, b.radius_of_balls, Dimension::length});
  }
  replace(document, "balancer", derived, s);
}

void replace_quantities(Document& document, const KeyTable& keys, const model::Scales& s) {
  StudyValue* table = find_table(document.root, keys.name);
  if (!table) return;  // absent, or not a table: the study reader says so
  TableReader reader(document, keys.name);
  for (const Key& line : keys.keys) {
    if (!line.dimension) continue;
    const std::string key = line.name;
    const Range range = quantity_range(line);
    const StudyValue* value = table->find(key);
    if (!value) continue;
    const double scale = scale_of(*line.dimension, s);
    Derived derived{key, key, {}};
    const StudyValue::Array* array = value->array();
    if (!array) {
      const auto reject = [&](const std::string& problem) { reader.fail(key, problem); };
      derived.values.push_back(measure_value(*value, {*line.dimension}, range, reject).value / scale);
    } else {
      for (const StudyValue& entry : *array) {
        const auto reject = [&](const std::string& problem) {
          reader.fail(key, fmt::format("entry {} {}", derived.values.size() + 1, problem));
        };
        derived.values.push_back(measure_value(entry, {*line.dimension}, range, reject).value / scale);
      }
    }
    put(document, *table, keys.name, derived, array != nullptr);
  }
}

// The first purely physical key; empty if there is none.
std::string physical_key(const Document& document) {
  for (const KeyTable& table : key_tables())
    for (const Key& key : table.keys)
      if (const std::string dotted = table.name + "." + key.name;
          physical_alone(table, key) && document.root.find_path(dotted))
        return dotted;
  return "";
}

// Without a mass nothing has a scale. The message names the key that makes the study physical: it may be a mistake.
void require_mass(const Document& document) {
  const std::string key = physical_key(document);
  if (key == "rotor.mass") return;
  throw InputError(document.where("rotor.mass", nullptr), "rotor.mass", "",
                   fmt::format("missing; must be {}, for {} makes this a study in physical units",
                               wanted_quantity({Dimension::mass}, positive), key));
}

void check_horizon(const Document& document, const model::Scales& s) {
  TableReader numerics(document, "numerics");
  if (!numerics.has("horizon")) return;
  const double horizon = numerics.number("horizon", any_number);
  const Range horizon_range = key_table("numerics").find("horizon", false)->range;
  if (!horizon_range.contains(horizon))
    numerics.fail("horizon", fmt::format("must be a time from {:.6g} s to {:.6g} s ({} to {} times 1/omega_c)",
                                         horizon_range.low * s.time(), horizon_range.high * s.time(), horizon_range.low,
                                         horizon_range.high));
}

}  // namespace

bool is_physical(const Document& document) { return !physical_key(document).empty(); }

BallDetails ball_details(const Document& document) {
  return is_physical(document) ? BalancerReader(document).read().details : BallDetails{};
}

void make_dimensionless(Document& document) {
  if (!is_physical(document)) return;
  if (const StudyValue* units = document.root.find("units"))
    throw InputError(
        document.where("units", units), "units", "",
        "belongs to a dimensionless study; here the units follow from rotor.mass, balancer.race_radius and "
        "rotor.stiffness");
  require_mass(document);
  const double motor_inertia = put_drive_sheet(document);
  const Rotor rotor = read_rotor(document);
  const Balancer balancer = BalancerReader(document).read();
  const model::Scales scales = model::Scales::of(rotor.mass, balancer.radius, rotor.mean_stiffness);
  replace(document, "rotor", rotor.derived, scales);
  replace_balancer(document, balancer, scales);
  if (StudyValue* inertia = document.root.find_path("rotor.inertia"); inertia && motor_inertia > 0.0)
    *inertia = inertia->number() + motor_inertia / scales.inertia();
  for (const KeyTable& table : key_tables())
    if (!is_machine(table.name)) replace_quantities(document, table, scales);
  document.scales = scales;
  check_horizon(document, scales);
}

}  // namespace equipoise::study
