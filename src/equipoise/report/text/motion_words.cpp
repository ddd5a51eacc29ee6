// What a motion is, how fast trajectories approach it, how large its vibration is; words for the names that
// attractors/motions/motion_name.cpp gives.
#include "equipoise/report/text/motion_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/results/commands/motion_table.hpp"

namespace equipoise {

namespace {

// By how names begin; longer beginnings first.
constexpr std::array<std::pair<std::string_view, const char*>, 11> plain_words{{
    {"co-drifting", "balls circulate together"},
    {"drifting apart", "balls circulate apart"},
    {"drifting at different rates", "balls circulate at different rates"},
    {"drifting", "ball circulates"},
    {"pair drift", "balls circulate as a pair"},
    {"one captured", "one ball stays, one circulates"},
    {"both captured", "balls stay, off balance"},
    {"all captured", "balls stay, off balance"},
    {"captured", "ball stays, off balance"},
    {"locked", "balls stay, off balance"},
    {"hanging", "balls stay below the shaft"},
}};

// In a continuum each member has its own stability.
std::string continuum_text(const ContinuumPart& part, double second, const char* unit) {
  if (part.slowest_rate == 0.0)
    return fmt::format("UNSTABLE, all of {} states drawn from the continuum, growth rates {:.5f} to {:.5f}{}",
                       part.drawn, part.least_growth / second, part.most_growth / second, unit);
  const std::string share = part.stable == part.drawn ? "all"
                            : part.stable == 0        ? fmt::format("less than 1 in {}", part.drawn)
                                                      : percent_text(part.share());
  return fmt::format("stable in part: {} of the continuum, slowest rates {:.5f} to {:.5f}{}", share,
                     part.fastest_rate / second, part.slowest_rate / second, unit);
}

}  // namespace

std::string plain_name(const std::string& name) {
  // What follows says which balls move as one and when the motion comes back: (2 together), quasi-periodic, period 3.
  for (const auto& [beginning, plain] : plain_words)
    if (name.starts_with(beginning)) return plain + name.substr(beginning.size());
  // "2 captured, 1 drifting"
  const std::size_t stay = name.find(" captured"), go = name.find(" drifting");
  if (stay == std::string::npos || go == std::string::npos || stay > go) return "";
  std::string text = name;
  text.replace(go, std::string_view(" drifting").size(), " circulating");
  return "balls: " + text.replace(stay, std::string_view(" captured").size(), " staying");
}

std::string stability_text(const Attractor& a, const std::optional<model::Scales>& scales) {
  const double second = scales ? scales->time() : 1.0;
  const char* unit = scales ? " /s" : "";
  if (a.motion.set_valued) return "a continuum that dry friction holds";
  if (a.continuum) return continuum_text(*a.continuum, second, unit);
  const Motion& m = a.motion;
  if (m.kind == MotionKind::measured) return "starts end in it; known by its measured motion alone";
  const char* verdict = m.stable ? "stable" : "UNSTABLE";
  if (m.kind == MotionKind::equilibrium && !m.depends_on_angle && !m.exponents.empty())
    return fmt::format("{}, slowest rate {:.5f}{}", verdict, m.exponents.front() / second, unit);
  if (const double multiplier = largest_multiplier(m); std::isfinite(multiplier))
    return fmt::format("{}, largest multiplier {:.4f}", verdict, multiplier);
  std::string text = fmt::format("{}, exponents", verdict);
  for (std::size_t k = 0; k < std::min<std::size_t>(3, m.exponents.size()); ++k)
    text += fmt::format(" {:.4f}", m.exponents[k] / second);
  return text + unit;
}

void to_json(Json& json, const BallEvent& e) {
  constexpr std::array<const char*, 6> words{"strike", "press", "part", "stick", "slip", "turn"};
  Json balls = {e.ball + 1};
  if (e.other >= 0) balls.push_back(e.other + 1);
  json = object("time", e.time, "kind", words[static_cast<std::size_t>(e.kind)], "balls", balls);
}

void to_json(Json& json, const ContinuumPart& part) {
  json = object("drawn", part.drawn, "stable", part.stable, "slowest_rate",
                std::array{part.slowest_rate, part.fastest_rate}, "growth_rate",
                std::array{part.least_growth, part.most_growth});
}

void to_json(Json& json, const PartOf<Attractor, Study>& of) {
  const auto& [a, study] = of;
  const int balls = study.parameters.balls;
  const Motion& m = a.motion;
  const auto number = [&](const char* name) { return motion_number(name).value(m); };
  const bool periodic = m.kind == MotionKind::periodic;
  json = object("id", a.id, "name", a.name, "alias", a.alias, "kind", name_of(m.kind), "copies", m.copies);
  put_known(json, "continuum", a.continuum);
  put(json, "period", number("period"), "winding", leading(m.winding, periodic ? balls : 0));
  if (periodic && m.depends_on_angle) put(json, "strobes", m.sections);
  put(json, "drift", leading(m.drift, balls), "rate",
      object("min", leading(m.rate_min, balls), "max", leading(m.rate_max, balls)));
  if (m.motor)
    put(json, "speed", extremes(m.motor->speed_min, m.speed, m.motor->speed_max), "torque", m.motor->torque, "power",
        object("motor", m.motor->power, "supports", m.motor->support_power));
  put(json, "radial", extremes(number("r_min"), number("r_mean"), number("r_max")));
  if (m.kind == MotionKind::equilibrium || periodic)
    put(json, m.kind == MotionKind::equilibrium && !m.depends_on_angle ? "eigenvalues" : "multipliers",
        list_of(m.spectrum, complex_pair), "residual", m.residual);
  put(json, "exponents", m.exponents, "stable", m.stable);
  if (m.eventful)
    put(json, "lasting", text_of(m.mode, balls), "events", m.events, "stuck", m.stuck, "continuum_of_friction",
        m.set_valued);
}

}  // namespace equipoise
