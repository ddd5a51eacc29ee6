// The resolved study as TOML: what a result remembers of the question it answers.
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/study/study.hpp"
#include "equipoise/study/table_reader.hpp"

namespace equipoise {

namespace {
using study::number_text;

template <class Container>
std::string array(const Container& values, std::size_t count) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < count; ++i) parts.push_back(number_text(values[i]));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string ramp_keys(const RampSetting& s) {
  if (s.profile == "constant") return fmt::format("speed = {}\n", number_text(s.speed));
  if (s.profile == "ramp")
    return fmt::format("initial = {}\nfinal = {}\nduration = {}\n", number_text(s.initial), number_text(s.final),
                       number_text(s.duration));
  if (s.profile == "trapezoid")
    return fmt::format("initial = {}\npeak = {}\nfinal = {}\nrise_until = {}\nhold_until = {}\nfall_until = {}\n",
                       number_text(s.initial), number_text(s.peak), number_text(s.final), number_text(s.rise_until),
                       number_text(s.hold_until), number_text(s.fall_until));
  return fmt::format("times = {}\nspeeds = {}\n", array(s.times, s.times.size()), array(s.speeds, s.speeds.size()));
}

std::string torque_keys(const TorqueSetting& t) {
  using Kind = model::MotorLaw::Kind;
  if (t.by_stall)
    return fmt::format("stall = {}\nno_load_speed = {}\n", number_text(t.stall), number_text(t.no_load_speed));
  if (t.kind == Kind::table)
    return fmt::format("times = {}\nvalues = {}\n", array(t.times, t.times.size()), array(t.values, t.values.size()));
  if (t.kind == Kind::control)
    return fmt::format("gain = {}\nintegral = {}\n{}\n[speed.torque.target]\nprofile = \"{}\"\n{}", number_text(t.gain),
                       number_text(t.integral), t.limit ? fmt::format("limit = {}\n", number_text(*t.limit)) : "",
                       t.target.profile, ramp_keys(t.target));
  return fmt::format("constant = {}\nslope = {}\n{}", number_text(t.constant), number_text(t.slope),
                     t.until ? fmt::format("until = {}\n", number_text(*t.until)) : "");
}

std::string speed_table(const SpeedSetting& s) {
  std::string text = fmt::format("[speed]\nprofile = \"{}\"\n", s.profile);
  if (s.driven()) {
    text += fmt::format("initial = {}\n", number_text(s.initial));
    if (s.stalled_below) text += fmt::format("stalled_below = {}\n", number_text(*s.stalled_below));
  } else {
    text += ramp_keys(s);
  }
  text += fmt::format("law = \"{}\"\n\n", s.law == model::SpeedLaw::kinematic ? "kinematic" : "published");
  if (s.driven()) text += "[speed.torque]\n" + torque_keys(s.torque) + "\n";
  return text;
}

// Only what is on: a rotor without them reads as it always did.
std::string race_keys(const model::Parameters& p) {
  const std::size_t n = static_cast<std::size_t>(p.balls);
  std::string text;
  if (!p.race_is_centred()) text += fmt::format("race_offset = {}\n", array(p.race_offset, 2));
  if (p.balls_stick()) text += fmt::format("rolling = {}\nstiction = {}\n", array(p.rolling, n), array(p.stiction, n));
  if (p.balls_collide()) text += fmt::format("contact_angle = {}\n", number_text(p.contact_angle));
  if (p.balls_collide() || p.restitution != model::Parameters{}.restitution)
    text += fmt::format("restitution = {}\n", number_text(p.restitution));
  return text;
}

std::string limits_text(const Limits& limits) {
  std::string keys;
  const auto add = [&](const char* key, const std::optional<double>& limit) {
    if (limit) keys += fmt::format("{} = {}\n", key, number_text(*limit));
  };
  add("displacement", limits.displacement);
  add("force", limits.force);
  add("velocity", limits.velocity);
  add("settled", limits.settled);
  return keys.empty() ? "" : "\n[limits]\n" + keys;
}

// SI: kg, m, rad/s.
std::string units_text(const std::optional<model::Scales>& scales) {
  if (!scales) return "";
  return fmt::format("\n[units]\nmass = {}\nlength = {}\nfrequency = {}\n", number_text(scales->mass),
                     number_text(scales->length), number_text(scales->frequency));
}

}  // namespace

std::string to_toml(const Study& study) {
  const model::Parameters& p = study.parameters;
  const std::size_t n = static_cast<std::size_t>(p.balls);
  std::string text =
      fmt::format("[rotor]\neccentricity = {}\ndamping = {}\nstiffness = {}\ngravity = {}\n",
                  number_text(p.eccentricity), array(p.damping, 2), array(p.stiffness, 2), number_text(p.gravity));
  if (p.inertia != 0.0) text += fmt::format("inertia = {}\n", number_text(p.inertia));
  text += fmt::format("\n[balancer]\nballs = {}\nmass = {}\ndrag = {}\n{}\n", n, array(p.mass, n), array(p.drag, n),
                      race_keys(p));
  text += speed_table(study.speed);
  if (study.release.speed || study.release.time) {
    text += "[release]\n";
    if (study.release.speed) text += fmt::format("speed = {}\n", number_text(*study.release.speed));
    if (study.release.time) text += fmt::format("time = {}\n", number_text(*study.release.time));
    text += "\n";
  }
  const InitialState& s = study.initial;
  text += fmt::format("[initial]\npsi = {}\nx = {}\ny = {}\nx_dot = {}\ny_dot = {}\n", number_text(s.psi),
                      number_text(s.x), number_text(s.y), number_text(s.x_dot), number_text(s.y_dot));
  text += fmt::format("phi = {}\nphi_dot = {}\n\n", array(s.phi, n), array(s.phi_dot, n));
  const auto method = static_cast<std::size_t>(study.sampling.method.value_or(SamplingMethod::random));
  text += fmt::format("[sampling]\nstarts = {}\nseed = {}\nmethod = \"{}\"\n\n", study.sampling.starts,
                      study.sampling.seed, sampling_method_names[method]);
  if (!study.sampling.box.empty()) {
    text += "[sampling.box]\n";
    for (const auto& [key, side] : box_sides)
      if (const auto& bounds = study.sampling.box.*side)
        text += fmt::format("{} = [{}, {}]\n", key, number_text(bounds->low), number_text(bounds->high));
    text += "\n";
  }
  text += "[numerics]\n";
  if (study.numerics.tolerance) text += fmt::format("tolerance = {}\n", number_text(*study.numerics.tolerance));
  if (study.numerics.horizon) text += fmt::format("horizon = {}\n", number_text(*study.numerics.horizon));
  text += fmt::format("decide = \"{}\"\n", decide_mode_names[static_cast<std::size_t>(study.numerics.decide)]);
  return text + limits_text(study.limits) + units_text(study.scales);
}

}  // namespace equipoise
