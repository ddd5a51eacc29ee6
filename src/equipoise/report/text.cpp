// Numbers and studies as text.
#include "equipoise/report/text.hpp"

#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include "equipoise/base/angles.hpp"

namespace equipoise {

namespace {

std::string list(const double* values, int count, bool same) {
  if (same) return fmt::format("{}", values[0]);
  std::string text = "[";
  for (int i = 0; i < count; ++i) text += fmt::format("{}{}", i ? ", " : "", values[i]);
  return text + "]";
}

std::string motor_text(const Study& study) {
  const TorqueSetting& t = study.speed.torque;
  using Kind = model::MotorLaw::Kind;
  std::string law;
  if (t.by_stall)
    law = fmt::format("torque {:.6g} at rest, 0 at {}", t.stall, rotor_speed_text(study, t.no_load_speed));
  else if (t.kind == Kind::table)
    law = fmt::format("torque by {} points in time", t.times.size());
  else if (t.kind == Kind::control)
    law = fmt::format("speed control to {}, gain {:.6g}, integral {:.6g}{}",
                      rotor_speed_text(study, study.motor().target.final_speed()), t.gain, t.integral,
                      t.limit ? fmt::format(", torque at most {:.6g}", *t.limit) : "");
  else
    law = fmt::format("torque {:.6g} {:+.6g} psi'{}", t.constant, t.slope,
                      t.until ? fmt::format(" until t = {:.6g}", *t.until) : "");
  return fmt::format("driven from {}: {}; inertia {:.6g}", rotor_speed_text(study, study.speed.initial), law,
                     study.parameters.inertia);
}

// What goes beyond the isotropic, horizontal rotor with balls that meet nothing but drag; empty if nothing does.
std::string more_text(const model::Parameters& p) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  if (p.stiffness[0] != p.stiffness[1]) add(fmt::format("stiffness [{:.6g}, {:.6g}]", p.stiffness[0], p.stiffness[1]));
  if (p.damping[0] != p.damping[1]) add(fmt::format("damping [{:.6g}, {:.6g}]", p.damping[0], p.damping[1]));
  if (p.gravity != 0.0) add(fmt::format("gravity {:.6g}", p.gravity));
  if (!p.race_is_centred()) add(fmt::format("race offset [{:.6g}, {:.6g}]", p.race_offset[0], p.race_offset[1]));
  if (p.balls_collide())
    add(fmt::format("balls touch at {:.6g} rad, restitution {:.6g}", p.contact_angle, p.restitution));
  if (p.balls_stick()) add(fmt::format("rolling resistance {:.6g}, stiction {:.6g}", p.rolling[0], p.stiction[0]));
  return text.empty() ? "" : text + "\n";
}

std::string units_text(const Study& study) {
  if (!study.scales) return "";
  return fmt::format("units: M = {:.6g} kg, R = {:.6g} mm, omega_c = {:.6g} rad/s ({:.6g} rpm)\n", study.scales->mass,
                     1e3 * study.scales->length, study.scales->frequency, study.scales->frequency * 30.0 / pi);
}

std::string speed_text(const Study& study) {
  const SpeedSetting& s = study.speed;
  std::string text;
  if (s.driven())
    text = motor_text(study);
  else if (s.profile == "constant")
    text = fmt::format("constant speed {}", s.speed);
  else if (s.profile == "ramp")
    text = fmt::format("ramp {} to {} in {}", s.initial, s.final, s.duration);
  else if (s.profile == "trapezoid")
    text = fmt::format("trapezoid {} to {} by {}, held to {}, to {} by {}", s.initial, s.peak, s.rise_until,
                       s.hold_until, s.final, s.fall_until);
  else
    text = fmt::format("{} speed points to {} at {}", s.times.size(), s.speeds.back(), s.times.back());
  const double release = study.release_time();
  if (std::isinf(release))
    text += fmt::format(", balls released at {}", rotor_speed_text(study, *study.release.speed));
  else if (release > 0.0)
    text += fmt::format(", balls released at t = {:.6g}", release);
  if (s.profile != "constant" && !s.driven())
    text += s.law == model::SpeedLaw::published ? "; PUBLISHED speed law, psi = t Omega(t)"
                                                : "; kinematic speed law, psi' = Omega(t)";
  return text;
}

}  // namespace

std::string percent(double share, int digits) { return fmt::format("{:.{}f} %", 100.0 * share, digits); }

int digits_for(const Share& s) {
  const double width = 100.0 * s.half_width();
  return width >= 1.0 ? 1 : width >= 0.05 ? 2 : width >= 0.005 ? 3 : 4;
}

std::string interval(const Share& s) {
  const int digits = digits_for(s);
  if (s.total == 0) return "-";
  if (s.count == 0) return "below " + percent(s.high, digits);
  if (s.count == s.total) return "above " + percent(s.low, digits);
  return fmt::format("{:.{}f} to {}", 100.0 * s.low, digits, percent(s.high, digits));
}

std::string study_heading(const Study& study) {
  const model::Parameters& p = study.parameters;
  std::string text = fmt::format("{}\n", study.name);
  text += fmt::format("{} ball{}: mass {}, drag {}; rotor: eccentricity {}, damping {}\n", p.balls,
                      p.balls == 1 ? "" : "s", list(p.mass.data(), p.balls, p.equal_balls()),
                      list(p.drag.data(), p.balls, p.equal_balls()), p.eccentricity, p.damping[0]);
  return text + more_text(p) + speed_text(study) + "\n" + units_text(study) + "\n";
}

std::string rotor_speed_text(const Study& study, double speed) {
  return study.scales ? fmt::format("{:.4g} rpm", speed * study.scales->frequency * 30.0 / pi)
                      : fmt::format("{:.6g}", speed);
}

const char* name_of(model::SpeedLaw law) { return law == model::SpeedLaw::published ? "published" : "kinematic"; }

nlohmann::ordered_json share_json(const Share& s) {
  return {{"count", s.count}, {"share", s.share}, {"low", s.low}, {"high", s.high}};
}

nlohmann::ordered_json study_json(const Study& study) {
  std::ostringstream text;
  text << toml::json_formatter{toml::parse(to_toml(study))};
  return nlohmann::ordered_json::parse(text.str());
}

}  // namespace equipoise
