// Numbers, studies and their starts as text.
#include "equipoise/report/text/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/balance/coincident_balls.hpp"
#include "equipoise/report/text/json.hpp"

namespace equipoise {

namespace {

using study::Dimension;

const char* held_by_default(Profile profile) {
  if (profile == Profile::trapezoid) return "the end of the rise";
  if (profile == Profile::hill) return "the end of the run-up";
  return profile == Profile::points ? "the last point of the speed" : "the end of the ramp";
}

// Writes the numbers of a study.
auto numbers_of(const Study& study) {
  return [&study](double value, Dimension d) { return engineering(study.scales, value, d); };
}

// One value for all balls, or one per ball; `factor` (only in physical units) multiplies each.
std::string list_text(const Study& study, const double* values, const double* factor, bool same, Dimension d) {
  const auto entry = [&](int i) {
    return engineering(study.scales, study.scales && factor ? values[i] * factor[i] : values[i], d);
  };
  if (same) return entry(0);
  std::string text = "[";
  for (int i = 0; i < study.parameters.balls; ++i) text += (i ? ", " : "") + entry(i);
  return text + "]";
}

std::string motor_text(const Study& study) {
  const TorqueSetting& t = study.speed.torque;
  using Kind = model::MotorLaw::Kind;
  const auto shown = numbers_of(study);
  const auto torque = [&](double value) { return shown(value, Dimension::torque); };
  const auto speed = [&](double value) { return shown(value, Dimension::speed); };
  std::string law;
  if (t.by_stall)
    law = fmt::format("torque {} at rest, none at {}", torque(t.stall), speed(t.no_load_speed));
  else if (t.kind == Kind::curve)
    law = fmt::format("torque by {} points in speed, at most {}", t.speeds.size(),
                      torque(*std::max_element(t.values.begin(), t.values.end())));
  else if (t.kind == Kind::table)
    law = fmt::format("torque by {} points in time", t.times.size());
  else if (t.kind == Kind::control)
    law = fmt::format("speed control to {}, gain {}{}", speed(study.motor().aim.final_speed()),
                      shown(t.gain, Dimension::gain),
                      t.limit ? fmt::format(", torque at most {}", torque(*t.limit)) : "");
  else
    law = fmt::format("torque {}, {} a unit of speed{}", torque(t.constant), shown(t.slope, Dimension::gain),
                      t.until ? fmt::format(", until t = {}", shown(*t.until, Dimension::time)) : "");
  const LoadSetting& load = study.speed.load;
  if (!load.is_none()) law += "; the machine takes " + torque(load.constant + load.linear + load.quadratic);
  if (load.linear + load.quadratic > 0.0) law += " at " + speed(*load.at);
  if (model::speeds_up_for_ever(study.system())) law += std::string("; the ") + model::holds_no_speed;
  return fmt::format("driven from {}: {}", speed(study.speed.initial), law);
}

// Features beyond an isotropic, horizontal rotor with balls subject only to drag; empty if there are none.
// One number then stands for all balls, in whatever planes they are.
bool alike(const std::array<double, model::max_balls>& values, int balls) {
  return std::count(values.begin(), values.begin() + balls, values[0]) == balls;
}

std::string more_text(const Study& study) {
  const model::Parameters& p = study.parameters;
  const auto shown = numbers_of(study);
  const auto both = [&](const std::array<double, 2>& v, Dimension d) {
    return fmt::format("[{}, {}]", shown(v[0], d), shown(v[1], d));
  };
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  if (p.stiffness[0] != p.stiffness[1]) add("stiffness " + both(p.stiffness, Dimension::stiffness));
  if (p.damping[0] != p.damping[1]) add("damping " + both(p.damping, Dimension::damping));
  if (p.gravity != 0.0) add("gravity " + shown(p.gravity, Dimension::acceleration));
  if (p.tilts()) {
    const bool same = alike(p.tilt.plane, p.balls);
    add(fmt::format("tilts: transverse inertia {}, polar {}", shown(p.tilt.transverse_inertia, Dimension::inertia),
                    shown(p.tilt.polar_inertia, Dimension::inertia)));
    if (p.balls > 0)
      add(fmt::format("ball{} in plane{} {}", plural(p.balls), same ? "" : "s",
                      list_text(study, p.tilt.plane.data(), nullptr, same, Dimension::length)));
  }
  if (!p.race_is_centred()) add("race offset " + both(p.race_offset, Dimension::length));
  if (p.rolls) {
    const bool same = alike(p.ball_radius, p.balls);
    add("balls roll, radius " + list_text(study, p.ball_radius.data(), nullptr, same, Dimension::length));
  }
  if (p.balls_collide())
    add(fmt::format("balls touch at {:.6g} rad, restitution {:.6g}", p.contact_angle, p.restitution));
  if (p.balls_stick()) add(fmt::format("rolling resistance {:.6g}, stiction {:.6g}", p.rolling[0], p.stiction[0]));
  return text.empty() ? "" : text + "\n";
}

std::string speed_text(const Study& study) {
  const SpeedSetting& s = study.speed;
  const auto shown = numbers_of(study);
  const auto speed = [&](double value) { return shown(value, Dimension::speed); };
  const auto time = [&](double value) { return shown(value, Dimension::time); };
  std::string text;
  if (s.driven())
    text = motor_text(study);
  else if (s.profile == Profile::constant)
    text = fmt::format("constant speed {}", speed(s.speed));
  else if (s.profile == Profile::ramp)
    text = fmt::format("ramp {} to {} in {}", speed(s.initial), speed(s.final), time(s.duration));
  else if (s.profile == Profile::trapezoid)
    text = fmt::format("trapezoid {} to {} by {}, held to {}, to {} by {}", speed(s.initial), speed(s.peak),
                       time(s.rise_until), time(s.hold_until), speed(s.final), time(s.fall_until));
  else if (s.profile == Profile::hill)
    text = fmt::format("run-up to {} by a Hill function, half of it at {}, exponent {:.6g}", speed(s.final),
                       time(s.half_time), s.exponent);
  else
    text = fmt::format("{} speed points to {} at {}", s.times.size(), speed(s.speeds.back()), time(s.times.back()));
  if (s.profile != Profile::constant && !s.driven())
    text += s.law == model::SpeedLaw::published ? "; PUBLISHED speed law, psi = t Omega(t)"
                                                : "; kinematic speed law, psi' = Omega(t)";
  return text;
}

// A noted quantity in the units of the study.
std::string quantity_text(const Study& study, const Note& note, const NotedQuantity& q) {
  if (q.kind == NotedQuantity::Kind::speed)
    return study.scales ? "at " + engineering(study.scales, q.least, Dimension::speed)
                        : fmt::format("at speed {:.4g}", q.least);
  if (!study.scales) return note.substr(q.begin, q.length);
  const double scale = study.scales->frequency;
  return q.least == q.most ? fmt::format("(growth rate {:.3g} 1/s)", q.least * scale)
                           : fmt::format("(growth rates {:.3g} to {:.3g} 1/s)", q.least * scale, q.most * scale);
}

}  // namespace

std::string percent(double share, int digits) { return fmt::format("{:.{}f} %", 100.0 * share, digits); }

int digits_for(const Share& s) {
  const double width = 100.0 * s.half_width();
  return width >= 1.0 ? 1 : width >= 0.05 ? 2 : width >= 0.005 ? 3 : 4;
}

std::string share_text(const Share& s) { return percent(s.share, s.count == 0 ? 0 : digits_for(s)); }

std::string interval(const Share& s) {
  const int digits = digits_for(s);
  if (s.total == 0) return "-";
  if (s.count == 0) return "below " + percent(s.high, digits);
  if (s.count == s.total) return "above " + percent(s.low, digits);
  return fmt::format("{:.{}f} to {}", 100.0 * s.low, digits, percent(s.high, digits));
}

std::string bounds_text(const Share& s) {
  Share bounds = s;
  bounds.low = s.least;
  bounds.high = s.most;
  bounds.count = s.least <= 0.0 ? 0 : s.most >= 1.0 ? s.total : s.count;
  return interval(bounds);
}

std::string release_text(const Study& study) {
  const double until = study.release_time();
  if (!(until > 0.0)) return "";
  const auto speed = [&] { return engineering(study.scales, *study.release.speed, study::Dimension::speed); };
  if (std::isinf(until)) return "balls held until the rotor comes to " + speed();
  std::string text = "balls held until t = " + engineering(study.scales, until, study::Dimension::time);
  if (study.release.speed) return text + ", at speed " + speed();
  return study.release.time ? text : fmt::format("{}, {}", text, held_by_default(study.speed.profile));
}

std::vector<std::string> drawn_instead(const Study& study) {
  std::vector<std::string> keys;
  const InitialState& s = study.initial;
  const SamplingBox& box = study.sampling.box;
  if (states_angles(study)) keys.emplace_back("initial.phi");
  const auto add = [&](const char* key, const auto& side, double value) {
    if (side && value != 0.0) keys.emplace_back(key);
  };
  add("initial.x", box.x, s.x);
  add("initial.y", box.y, s.y);
  add("initial.x_dot", box.x_dot, s.x_dot);
  add("initial.y_dot", box.y_dot, s.y_dot);
  const bool turning = std::any_of(s.phi_dot.begin(), s.phi_dot.end(), [](double rate) { return rate != 0.0; });
  add("initial.phi_dot", box.phi_dot, turning);
  return keys;
}

std::string drawn_instead_text(const Study& study) {
  const std::vector<std::string> keys = drawn_instead(study);
  if (keys.empty()) return "";
  return fmt::format("drawn with each start, not taken from the study: {}; simulate starts from there\n",
                     fmt::join(keys, ", "));
}

std::string coincident_text(const Study& study) {
  const model::Parameters& p = study.parameters;
  const InitialState& s = study.initial;
  std::string pairs;
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < i; ++k)
      if (model::coincide(p, i, k, s.phi.data(), s.phi_dot.data()))
        pairs += fmt::format("{}balls {} and {}", pairs.empty() ? "" : ", ", k + 1, i + 1);
  if (pairs.empty()) return "";
  return pairs +
         " are alike and start in one place; computed exactly they would stay together, and real ones part: they are "
         "set about 1e-9 rad apart";
}

std::string study_heading(const Study& study) {
  const model::Parameters& p = study.parameters;
  std::string text = fmt::format("{}\n", study.name);
  const auto shown = numbers_of(study);
  const bool same = alike(p.mass, p.balls) && alike(p.drag, p.balls);
  if (p.balls == 0)
    text += "no balls; ";
  else
    text += fmt::format("{} ball{}: mass {}, drag {}; ", p.balls, plural(p.balls),
                        list_text(study, p.mass.data(), nullptr, same, Dimension::mass),
                        list_text(study, p.drag.data(), p.mass.data(), same, Dimension::gain));
  text += fmt::format("rotor: eccentricity {}, damping {}\n", shown(p.eccentricity, Dimension::length),
                      shown(p.damping[0], Dimension::damping));
  if (study.scales)
    text +=
        fmt::format(fmt::runtime(p.tilts() || p.stiffness[0] != p.stiffness[1] ? "sqrt(k/M) = {}, 1/omega_c = {}\n"
                                                                               : "critical speed {}, 1/omega_c = {}\n"),
                    shown(1.0, Dimension::speed), shown(1.0, Dimension::time));
  const std::string held = release_text(study);
  return text + more_text(study) + speed_text(study) + "\n" + (held.empty() ? "" : held + "\n") + "\n";
}

std::string note_text(const Study& study, const Note& note) {
  std::string text;
  std::size_t done = 0;
  for (const NotedQuantity& q : note.quantities) {
    text += note.substr(done, q.begin - done) + quantity_text(study, note, q);
    done = q.begin + q.length;
  }
  return text + note.substr(done);
}

std::optional<model::Carrying> carrying(const Study& study) { return model::carrying(study.parameters, study.drive()); }

std::string carried_text(const Study& study, const model::Carrying& c) {
  if (std::isinf(c.all)) return "balls without drag are never carried round";
  const std::string all = engineering(study.scales, c.all, study::Dimension::speed),
                    first = engineering(study.scales, c.first, study::Dimension::speed);
  return first == all
             ? fmt::format("drag carries hanging balls round from {} on", all)
             : fmt::format("drag carries the first of hanging balls round from {} on, all from {} on", first, all);
}

std::string hanging_text(const Study& study) {
  const auto c = carrying(study);
  if (!c || !c->may_hang()) return "";
  std::string text =
      "balls that hang below the shaft at the final speed stay there and balance nothing, unless vibration frees "
      "them: " +
      carried_text(study, *c);
  const double factor = c->all / c->reached;
  return std::isinf(factor) ? text
                            : text + fmt::format("; at the speed reached it takes {:.4g} times the drag", factor);
}

const char* name_of(model::SpeedLaw law) { return speed_law_names[static_cast<std::size_t>(law)]; }

void to_json(Json& json, const StudyValue& value) {
  if (const auto* table = value.table()) {
    json = Json::object();
    for (const auto& [key, member] : *table) json[key] = member;
  } else if (const auto* array = value.array()) {
    json = *array;
  } else if (const auto* truth = value.boolean()) {
    json = *truth;
  } else if (value.is_number()) {
    json = value.integer() ? Json(*value.integer()) : Json(*value.real());
  } else {
    json = value.string() ? *value.string() : value.other()->text;
  }
}

void to_json(Json& json, const Study& study) { json = to_tree(study); }

}  // namespace equipoise
