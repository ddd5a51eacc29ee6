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

std::string speed_keys(const SpeedSetting& s) {
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
      fmt::format("[rotor]\neccentricity = {}\ndamping = {}\nstiffness = {}\ngravity = {}\n\n",
                  number_text(p.eccentricity), array(p.damping, 2), array(p.stiffness, 2), number_text(p.gravity));
  text += fmt::format("[balancer]\nballs = {}\nmass = {}\ndrag = {}\n\n", n, array(p.mass, n), array(p.drag, n));
  text += fmt::format("[speed]\nprofile = \"{}\"\n{}law = \"{}\"\n\n", study.speed.profile, speed_keys(study.speed),
                      study.speed.law == model::SpeedLaw::kinematic ? "kinematic" : "published");
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
  text += fmt::format("horizon = {}\n", number_text(study.numerics.horizon));
  text += fmt::format("decide = \"{}\"\n", decide_mode_names[static_cast<std::size_t>(study.numerics.decide)]);
  return text + limits_text(study.limits) + units_text(study.scales);
}

}  // namespace equipoise
