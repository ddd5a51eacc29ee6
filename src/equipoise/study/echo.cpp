// The resolved study as a tree and as TOML: what a result remembers of the question it answers.
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "equipoise/study/study.hpp"
#include "equipoise/study/toml_tree.hpp"
#include "equipoise/study/units.hpp"

namespace equipoise {

namespace {

template <class Container>
StudyValue first(const Container& values, std::size_t count) {
  return std::vector<double>(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
}

void set_if(StudyValue& table, const char* key, const std::optional<double>& value) {
  if (value) table.set(key, *value);
}

// What an enumeration's value is called; of one that code made up, its number, which no reader takes.
template <class Names, class Enumeration>
StudyValue name_among(const Names& names, Enumeration value) {
  const auto index = static_cast<std::size_t>(value);
  if (index < names.size()) return names[index];
  return StudyValue::Other{"a number", std::to_string(static_cast<long long>(value))};
}

// Arrays are as long as a study may have balls, whatever it says.
std::size_t ball_count(const model::Parameters& p) {
  return static_cast<std::size_t>(std::clamp(p.balls, 0, model::max_balls));
}

StudyValue rotor_table(const model::Parameters& p) {
  StudyValue rotor{{"eccentricity", p.eccentricity},
                   {"damping", first(p.damping, 2)},
                   {"stiffness", first(p.stiffness, 2)},
                   {"gravity", p.gravity}};
  if (p.inertia != 0.0) rotor.set("inertia", p.inertia);
  return rotor;
}

// Of race and balls only what is on: a rotor without them reads as it always did.
StudyValue balancer_table(const model::Parameters& p) {
  const std::size_t n = ball_count(p);
  StudyValue balancer{{"balls", p.balls}, {"mass", first(p.mass, n)}, {"drag", first(p.drag, n)}};
  if (!p.race_is_centred()) balancer.set("race_offset", first(p.race_offset, 2));
  const auto any = [&](const auto& values) {
    return std::any_of(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n),
                       [](double v) { return v != 0.0; });
  };
  if (any(p.rolling) || any(p.stiction)) {
    balancer.set("rolling", first(p.rolling, n));
    balancer.set("stiction", first(p.stiction, n));
  }
  if (p.rolls) {
    balancer.set("rolls", true);
    balancer.set("ball_radius", first(p.ball_radius, n));
  }
  if (p.contact_angle != 0.0) balancer.set("contact_angle", p.contact_angle);
  if (p.contact_angle != 0.0 || p.restitution != model::Parameters{}.restitution)
    balancer.set("restitution", p.restitution);
  return balancer;
}

void add_ramp(StudyValue& table, const RampSetting& s) {
  if (s.profile == Profile::constant) {
    table.set("speed", s.speed);
  } else if (s.profile == Profile::ramp) {
    table.set("initial", s.initial);
    table.set("final", s.final);
    table.set("duration", s.duration);
  } else if (s.profile == Profile::trapezoid) {
    table.set("initial", s.initial);
    table.set("peak", s.peak);
    table.set("final", s.final);
    table.set("rise_until", s.rise_until);
    table.set("hold_until", s.hold_until);
    table.set("fall_until", s.fall_until);
  } else {
    table.set("times", s.times);
    table.set("speeds", s.speeds);
  }
}

// A motor that says it is of two kinds gets the keys of both, which no reader takes.
StudyValue torque_table(const TorqueSetting& t) {
  using Kind = model::MotorLaw::Kind;
  StudyValue torque;
  if (t.by_stall) {
    torque.set("stall", t.stall);
    torque.set("no_load_speed", t.no_load_speed);
  }
  if (t.kind == Kind::table) {
    torque.set("times", t.times);
    torque.set("values", t.values);
  } else if (t.kind == Kind::control) {
    torque.set("gain", t.gain);
    torque.set("integral", t.integral);
    set_if(torque, "limit", t.limit);
    add_ramp(torque.set("target", StudyValue{{"profile", name_among(profile_names, t.target.profile)}}), t.target);
  } else if (!t.by_stall) {
    torque.set("constant", t.constant);
    torque.set("slope", t.slope);
    set_if(torque, "until", t.until);
  }
  return torque;
}

StudyValue speed_table(const SpeedSetting& s) {
  StudyValue speed{{"profile", name_among(profile_names, s.profile)}};
  if (s.driven()) {
    speed.set("initial", s.initial);
    set_if(speed, "stalled_below", s.stalled_below);
  } else {
    add_ramp(speed, s);
  }
  speed.set("law", name_among(speed_law_names, s.law));
  if (s.driven()) speed.set("torque", torque_table(s.torque));
  return speed;
}

// Ball angles that nobody chose are left out: a result that draws them must not seem to start from these.
StudyValue initial_table(const Study& study) {
  const InitialState& s = study.initial;
  const std::size_t balls = ball_count(study.parameters);
  StudyValue initial{{"psi", s.psi}, {"x", s.x}, {"y", s.y}, {"x_dot", s.x_dot}, {"y_dot", s.y_dot}};
  if (states_angles(study)) initial.set("phi", first(s.phi, balls));
  initial.set("phi_dot", first(s.phi_dot, balls));
  return initial;
}

StudyValue sampling_table(const Sampling& s) {
  StudyValue sampling{{"starts", s.starts},
                      {"seed", s.seed},
                      {"method", name_among(sampling_method_names, s.method.value_or(SamplingMethod::random))}};
  if (s.box.empty()) return sampling;
  StudyValue& box = sampling.set("box", {});
  for (const auto& [key, side] : box_sides)
    if (const auto& bounds = s.box.*side) box.set(key, std::vector<double>{bounds->low, bounds->high});
  return sampling;
}

StudyValue numerics_table(const Numerics& n) {
  StudyValue numerics;
  set_if(numerics, "tolerance", n.tolerance);
  set_if(numerics, "horizon", n.horizon);
  numerics.set("decide", name_among(decide_mode_names, n.decide));
  return numerics;
}

StudyValue limits_table(const Limits& l) {
  StudyValue limits;
  set_if(limits, "displacement", l.displacement);
  set_if(limits, "force", l.force);
  set_if(limits, "velocity", l.velocity);
  set_if(limits, "settled", l.settled);
  return limits;
}

StudyValue tree_with_medians(const Study& study) {
  StudyValue tree{{"rotor", rotor_table(study.parameters)},
                  {"balancer", balancer_table(study.parameters)},
                  {"speed", speed_table(study.speed)}};
  StudyValue release;
  set_if(release, "speed", study.release.speed);
  set_if(release, "time", study.release.time);
  if (!release.table()->empty()) tree.set("release", release);
  tree.set("initial", initial_table(study));
  tree.set("sampling", sampling_table(study.sampling));
  tree.set("numerics", numerics_table(study.numerics));
  if (const StudyValue limits = limits_table(study.limits); !limits.table()->empty()) tree.set("limits", limits);
  if (const auto& scales = study.scales)  // SI: kg, m, rad/s
    tree.set("units", StudyValue{{"mass", scales->mass}, {"length", scales->length}, {"frequency", scales->frequency}});
  return tree;
}

// What may have changed since the study was read: how it is sampled and followed.
void update_written(const Study& study, StudyValue& tree) {
  for (const char* table : {"sampling", "numerics"})
    if (!tree.find(table)) tree.set(table, {});
  StudyValue &sampling = *tree.find("sampling"), &numerics = *tree.find("numerics");
  const StudyValue now = sampling_table(study.sampling), followed = numerics_table(study.numerics);
  for (const char* key : {"starts", "seed", "method"}) sampling.set(key, *now.find(key));
  for (const char* key : {"tolerance", "decide"})
    if (const StudyValue* value = followed.find(key)) numerics.set(key, *value);
  const std::optional<double> horizon = study.numerics.horizon;
  if (horizon && horizon != study.uncertain.horizon)
    numerics.set("horizon", study::quantity_text(*horizon * study.scales->time(), study::Dimension::time));
}

// As a reader has the keys: what is written does not depend on the order in which it came.
StudyValue sorted(const StudyValue& value) {
  const StudyValue::Table* members = value.table();
  if (!members) return value;
  std::vector<const StudyValue::Member*> order;
  for (const StudyValue::Member& member : *members) order.push_back(&member);
  std::sort(order.begin(), order.end(), [](const auto* a, const auto* b) { return a->key < b->key; });
  StudyValue result;
  for (const StudyValue::Member* member : order) result.set(member->key, sorted(member->value));
  return result;
}

void put_distributions(const Study& study, StudyValue& tree) {
  for (const UncertainValue& value : study.uncertain.values) {
    const std::size_t dot = value.key.rfind('.');
    if (StudyValue* table = tree.find_path(std::string_view(value.key).substr(0, dot)))
      table->set(value.key.substr(dot + 1), value.written());
    // Stiction that is not stated is drawn with it.
    if (value.key == "balancer.rolling" && study.parameters.stiction == study.parameters.rolling)
      tree.find("balancer")->erase("stiction");
  }
  if (study.uncertain.rests)
    for (const char* key : {"x", "y", "x_dot", "y_dot"}) tree.find("initial")->erase(key);
}

}  // namespace

StudyValue to_tree(const Study& study) {
  if (!study.uncertain.physical) {
    StudyValue tree = tree_with_medians(study);
    put_distributions(study, tree);
    return tree;
  }
  StudyValue tree = *study.uncertain.physical;
  update_written(study, tree);
  return sorted(tree);
}

std::string to_toml(const Study& study) { return to_toml(to_tree(study)); }

std::string to_toml(const StudyValue& tree) { return study::toml_text(tree); }

}  // namespace equipoise
