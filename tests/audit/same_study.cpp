// Mirror, order of balls, physical units.
#include "same_study.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/study/echo/physical_echo.hpp"

namespace equipoise::audit {

namespace {

void turn_back(RampSetting& ramp) {
  ramp.speed = -ramp.speed;
  ramp.initial = -ramp.initial;
  ramp.final = -ramp.final;
  ramp.peak = -ramp.peak;
  for (double& speed : ramp.speeds) speed = -speed;
}

void turn_back(std::optional<SamplingBox::Side>& side) {
  if (side) side = SamplingBox::Side{-side->high, -side->low};
}

// tau(t, psi') becomes -tau(t, -psi').
void turn_back(TorqueSetting& torque) {
  torque.constant = -torque.constant;
  for (double& value : torque.values) value = -value;
  turn_back(torque.target);
}

}  // namespace

std::optional<Study> mirrored(const Study& study) {
  Study m = study;
  if (m.speed.driven() && m.speed.torque.by_stall) {
    TorqueSetting& t = m.speed.torque;
    t.by_stall = false;
    t.constant = t.stall;
    t.slope = -t.stall / t.no_load_speed;
  }
  if (m.speed.driven() && m.speed.stalled_below) return std::nullopt;            // a bound on a signed speed
  if (m.speed.torque.kind == model::MotorLaw::Kind::curve) return std::nullopt;  // its ends differ
  turn_back(m.speed);
  turn_back(m.speed.torque);
  if (m.release.speed) m.release.speed = -*m.release.speed;
  m.parameters.race_offset[1] = -m.parameters.race_offset[1];
  InitialState& s = m.initial;
  s.psi = -s.psi;
  s.y = -s.y;
  s.y_dot = -s.y_dot;
  for (double& rate : s.phi_dot) rate = -rate;
  turn_back(m.sampling.box.y);
  turn_back(m.sampling.box.y_dot);
  turn_back(m.sampling.box.phi_dot);
  if (study.parameters.gravity != 0.0) {
    // Left becomes right, but down stays down: angles count from the other side of the horizontal.
    s.psi = 3.14159265358979323846 + s.psi;
    // phi -> -phi with psi -> pi - psi: the mirror's plane is vertical.
  }
  return m;
}

Study reversed(const Study& study) {
  Study r = study;
  const auto reverse = [&](auto& values) { std::reverse(values.begin(), values.begin() + study.parameters.balls); };
  reverse(r.parameters.mass);
  reverse(r.parameters.drag);
  reverse(r.parameters.rolling);
  reverse(r.parameters.stiction);
  reverse(r.parameters.ball_radius);
  reverse(r.initial.phi);
  reverse(r.initial.phi_dot);
  return r;
}

namespace {

std::string quantity(double value, double scale, const char* unit) {
  return fmt::format("\"{:.17g} {}\"", value * scale, unit);
}

template <class Values>
std::string quantities(const Values& values, std::size_t count, double scale, const char* unit) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < count; ++i) parts.push_back(quantity(values[i], scale, unit));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

template <class Values>
std::string plain(const Values& values, std::size_t count) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < count; ++i) parts.push_back(fmt::format("{:.17g}", values[i]));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

template <class Names, class Enumeration>
std::string name_of(const Names& names, Enumeration value) {
  return names[static_cast<std::size_t>(value)];
}

std::string ramp_text(const RampSetting& s, const model::Scales& u) {
  const double f = u.frequency, t = u.time();
  if (s.profile == Profile::constant) return "speed = " + quantity(s.speed, f, "rad/s") + "\n";
  if (s.profile == Profile::points)
    return "times = " + quantities(s.times, s.times.size(), t, "s") +
           "\nspeeds = " + quantities(s.speeds, s.speeds.size(), f, "rad/s") + "\n";
  if (s.profile == Profile::hill)
    return "final = " + quantity(s.final, f, "rad/s") + "\nhalf_time = " + quantity(s.half_time, t, "s") +
           fmt::format("\nexponent = {:.17g}\n", s.exponent) +
           (s.until ? "until = " + quantity(*s.until, t, "s") + "\n" : "");
  std::string text =
      "initial = " + quantity(s.initial, f, "rad/s") + "\nfinal = " + quantity(s.final, f, "rad/s") + "\n";
  if (s.profile == Profile::ramp) return text + "duration = " + quantity(s.duration, t, "s") + "\n";
  return text + "peak = " + quantity(s.peak, f, "rad/s") + "\nrise_until = " + quantity(s.rise_until, t, "s") +
         "\nhold_until = " + quantity(s.hold_until, t, "s") + "\nfall_until = " + quantity(s.fall_until, t, "s") + "\n";
}

std::string torque_text(const TorqueSetting& t, const model::Scales& u) {
  using Kind = model::MotorLaw::Kind;
  const double gain = u.torque() / u.frequency;
  std::string text = "[speed.torque]\n";
  if (t.by_stall)
    return text + "stall = " + quantity(t.stall, u.torque(), "N m") +
           "\nno_load_speed = " + quantity(t.no_load_speed, u.frequency, "rad/s") + "\n";
  if (t.kind == Kind::table)
    return text + "times = " + quantities(t.times, t.times.size(), u.time(), "s") +
           "\nvalues = " + quantities(t.values, t.values.size(), u.torque(), "N m") + "\n";
  if (t.kind == Kind::curve)
    return text + "speeds = " + quantities(t.speeds, t.speeds.size(), u.frequency, "rad/s") +
           "\nvalues = " + quantities(t.values, t.values.size(), u.torque(), "N m") + "\n";
  if (t.kind == Kind::control) {
    text +=
        "gain = " + quantity(t.gain, gain, "N m s") + "\nintegral = " + quantity(t.integral, u.torque(), "N m") + "\n";
    if (t.limit) text += "limit = " + quantity(*t.limit, u.torque(), "N m") + "\n";
    return text + "[speed.torque.target]\nprofile = \"" + name_of(profile_names, t.target.profile) + "\"\n" +
           ramp_text(t.target, u);
  }
  text +=
      "constant = " + quantity(t.constant, u.torque(), "N m") + "\nslope = " + quantity(t.slope, gain, "N m s") + "\n";
  if (t.until) text += "until = " + quantity(*t.until, u.time(), "s") + "\n";
  return text;
}

std::string load_text(const LoadSetting& l, const model::Scales& u) {
  if (l.is_none()) return "";
  return "[speed.load]\nconstant = " + quantity(l.constant, u.torque(), "N m") +
         "\nlinear = " + quantity(l.linear, u.torque(), "N m") +
         "\nquadratic = " + quantity(l.quadratic, u.torque(), "N m") +
         "\nat = " + quantity(l.at.value_or(1.0), u.frequency, "rad/s") + "\n";
}

std::string rotor_text(const model::Parameters& p, const model::Scales& u) {
  const double k = u.mass * u.frequency * u.frequency, c = u.mass * u.frequency;
  std::string text = "[rotor]\nmass = " + quantity(1.0, u.mass, "kg") +
                     "\nstiffness = " + quantities(p.stiffness, 2, k, "N/m") +
                     "\ndamping = " + quantities(p.damping, 2, c, "N s/m") +
                     "\neccentricity = " + quantity(p.eccentricity, u.length, "m") + "\n";
  if (p.gravity != 0.0) text += "gravity = " + quantity(p.gravity, u.acceleration(), "m/s2") + "\n";
  if (p.inertia != 0.0) text += "inertia = " + quantity(p.inertia, u.inertia(), "kg m2") + "\n";
  return text;
}

std::string balancer_text(const model::Parameters& p, const model::Scales& u) {
  const std::size_t n = static_cast<std::size_t>(p.balls);
  std::vector<double> drag;
  for (std::size_t i = 0; i < n; ++i) drag.push_back(p.drag[i] * p.mass[i]);
  std::string text = fmt::format("[balancer]\nballs = {}\nrace_radius = {}\n", n, quantity(1.0, u.length, "m"));
  text += "mass = " + quantities(p.mass, n, u.mass, "kg") +
          "\ndrag = " + quantities(drag, n, u.inertia() * u.frequency, "N m s") + "\n";
  if (!p.race_is_centred()) text += "race_offset = " + quantities(p.race_offset, 2, u.length, "m") + "\n";
  if (p.balls_stick()) text += "rolling = " + plain(p.rolling, n) + "\nstiction = " + plain(p.stiction, n) + "\n";
  if (p.rolls) text += "rolls = true\nball_radius = " + quantities(p.ball_radius, n, u.length, "m") + "\n";
  if (p.balls_collide())
    text += fmt::format("contact_angle = {:.17g}\nrestitution = {:.17g}\n", p.contact_angle, p.restitution);
  return text;
}

std::string start_text(const Study& s, const model::Scales& u) {
  const std::size_t n = static_cast<std::size_t>(s.parameters.balls);
  const InitialState& i = s.initial;
  std::string text = fmt::format("[initial]\npsi = {:.17g}\n", i.psi);
  text += "x = " + quantity(i.x, u.length, "m") + "\ny = " + quantity(i.y, u.length, "m") +
          "\nx_dot = " + quantity(i.x_dot, u.velocity(), "m/s") +
          "\ny_dot = " + quantity(i.y_dot, u.velocity(), "m/s") + "\nphi = " + plain(i.phi, n) +
          "\nphi_dot = " + quantities(i.phi_dot, n, u.frequency, "rad/s") + "\n";
  text += fmt::format("[sampling]\nstarts = {}\nseed = {}\n", s.sampling.starts, s.sampling.seed);
  if (s.sampling.box.empty()) return text;
  text += "[sampling.box]\n";
  const auto side = [&](const char* key, const std::optional<SamplingBox::Side>& box, double scale, const char* unit) {
    if (box)
      text += fmt::format("{} = [{}, {}]\n", key, quantity(box->low, scale, unit), quantity(box->high, scale, unit));
  };
  side("x", s.sampling.box.x, u.length, "m");
  side("y", s.sampling.box.y, u.length, "m");
  side("x_dot", s.sampling.box.x_dot, u.velocity(), "m/s");
  side("y_dot", s.sampling.box.y_dot, u.velocity(), "m/s");
  side("phi_dot", s.sampling.box.phi_dot, u.frequency, "rad/s");
  return text;
}

}  // namespace

std::optional<std::string> physical_text(const Study& silent, const model::Scales& u) {
  const Study study = stating_release(silent);
  const model::Parameters& p = study.parameters;
  if (p.stiffness[0] + p.stiffness[1] != 2.0) return std::nullopt;
  std::string text = rotor_text(p, u) + balancer_text(p, u);
  text += fmt::format("[speed]\nprofile = \"{}\"\nlaw = \"{}\"\n", name_of(profile_names, study.speed.profile),
                      name_of(speed_law_names, study.speed.law));
  if (study.speed.driven()) {
    text += "initial = " + quantity(study.speed.initial, u.frequency, "rad/s") + "\n";
    if (study.speed.stalled_below)
      text += "stalled_below = " + quantity(*study.speed.stalled_below, u.frequency, "rad/s") + "\n";
    text += torque_text(study.speed.torque, u) + load_text(study.speed.load, u);
  } else {
    text += ramp_text(study.speed, u);
  }
  if (study.release.speed) text += "[release]\nspeed = " + quantity(*study.release.speed, u.frequency, "rad/s") + "\n";
  if (study.release.time) text += "[release]\ntime = " + quantity(*study.release.time, u.time(), "s") + "\n";
  return text + start_text(study, u);
}

std::string numbers_differ(const Study& a, const Study& b) {
  // An echo leaves evenly spread angles out if its study does not state them; the text in SI units states all.
  const auto echo = [](const Study& study) {
    Study stating = stating_release(study);
    stating.angles_stated = true;
    return to_toml(stating);
  };
  std::istringstream first(echo(a)), second(echo(b));
  std::string line, other;
  while (std::getline(first, line) && std::getline(second, other)) {
    if (line.starts_with("[units]") || other.starts_with("[units]")) return {};
    const char* x = line.c_str();
    const char* y = other.c_str();
    while (*x && *y) {
      char *x_end, *y_end;
      const double u = std::strtod(x, &x_end), v = std::strtod(y, &y_end);
      const bool numbers = x_end != x && y_end != y;
      // About ten roundings; 0 stays 0 under any scaling.
      if (numbers ? !(std::fabs(u - v) <= 1e-12 * std::fabs(u)) : *x != *y) return line + " | " + other;
      x = numbers ? x_end : x + 1;
      y = numbers ? y_end : y + 1;
    }
    if (*x != *y) return line + " | " + other;
  }
  return {};
}

}  // namespace equipoise::audit
