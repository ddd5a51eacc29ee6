// What a motion is, how fast trajectories come to it, how large its vibration is.
#include "equipoise/report/text/motion_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/percent_text.hpp"
#include "equipoise/report/words/text.hpp"
#include "equipoise/results/commands/motion_table.hpp"

namespace equipoise {

namespace {

using Json = nlohmann::ordered_json;

Json events_json(const Motion& m) {
  constexpr std::array<const char*, 6> words{"strike", "press", "part", "stick", "slip", "turn"};
  Json events = Json::array();
  for (const BallEvent& e : m.events) {
    Json one = {{"time", e.time}, {"kind", words[static_cast<std::size_t>(e.kind)]}, {"balls", {e.ball + 1}}};
    if (e.other >= 0) one["balls"].push_back(e.other + 1);
    events.push_back(one);
  }
  return events;
}

// In a continuum each member has its own stability.
std::string continuum_text(const ContinuumPart& part, const TableUnits& units) {
  if (part.slowest_rate == 0.0)
    return fmt::format(words::text::continuum_unstable, part.drawn, part.least_growth / units.time,
                       part.most_growth / units.time, units.rate);
  const std::string share = part.stable == part.drawn ? "all"
                            : part.stable == 0        ? fmt::format(words::text::less_than_one_in, part.drawn)
                                                      : percent_text(part.share());
  return fmt::format(words::text::continuum_stable_in_part, share, part.fastest_rate / units.time,
                     part.slowest_rate / units.time, units.rate);
}

}  // namespace

std::string stability_text(const Attractor& a, const TableUnits& units) {
  if (a.motion.set_valued) return words::text::held_by_friction;
  if (a.continuum) return continuum_text(*a.continuum, units);
  const Motion& m = a.motion;
  if (m.kind == MotionKind::measured) return words::text::known_by_measurement;
  const char* verdict = m.stable ? "stable" : "UNSTABLE";
  if (m.kind == MotionKind::equilibrium && !m.depends_on_angle && !m.exponents.empty())
    return fmt::format(words::text::slowest_rate, verdict, m.exponents.front() / units.time, units.rate);
  if (const double multiplier = largest_multiplier(m); std::isfinite(multiplier))
    return fmt::format(words::text::largest_multiplier, verdict, multiplier);
  std::string text = fmt::format("{}, exponents", verdict);
  for (std::size_t k = 0; k < std::min<std::size_t>(3, m.exponents.size()); ++k)
    text += fmt::format(" {:.4f}", m.exponents[k] / units.time);
  return text + units.rate;
}

TableUnits::TableUnits(const std::optional<model::Scales>& scales) {
  if (!scales) return;
  length = 1000.0 * scales->length;
  time = scales->time();
  speed = scales->frequency * 30.0 / pi;
  torque = scales->torque();
  power = scales->torque() * scales->frequency;
  r = ", mm";
  period = ", s";
  drift = ", rpm";
  moment = ", N m";
  watts = ", W";
  rate = " /s";
}

nlohmann::ordered_json continuum_json(const ContinuumPart& part) {
  return {{"drawn", part.drawn},
          {"stable", part.stable},
          {"slowest_rate", {part.slowest_rate, part.fastest_rate}},
          {"growth_rate", {part.least_growth, part.most_growth}}};
}

nlohmann::ordered_json motion_json(const Attractor& a, const Study& study) {
  const int balls = study.parameters.balls;
  const Motion& m = a.motion;
  Json json = {{"id", a.id}, {"name", a.name}, {"alias", a.alias}, {"kind", name_of(m.kind)}, {"copies", m.copies}};
  if (a.continuum)
    json["continuum"] = continuum_json(*a.continuum);
  const bool periodic = m.kind == MotionKind::periodic;
  json["period"] = motion_number("period").value(m);  // null of what is not periodic
  json["winding"] = std::vector<int>(m.winding.begin(), m.winding.begin() + (periodic ? balls : 0));
  if (periodic && m.depends_on_angle) json["strobes"] = m.sections;
  const auto list = [&](const auto& values) { return std::vector<double>(values.begin(), values.begin() + balls); };
  json["drift"] = list(m.drift);
  json["rate"] = {{"min", list(m.rate_min)}, {"max", list(m.rate_max)}};
  if (m.motor) {
    json["speed"] = {{"min", m.motor->speed_min}, {"mean", m.speed}, {"max", m.motor->speed_max}};
    json["torque"] = m.motor->torque;
    json["power"] = {{"motor", m.motor->power}, {"supports", m.motor->support_power}};
  }
  const auto number = [&](const char* name) { return motion_number(name).value(m); };
  json["radial"] = {{"min", number("r_min")}, {"mean", number("r_mean")}, {"max", number("r_max")}};
  if (m.kind == MotionKind::equilibrium || periodic) {
    Json spectrum = Json::array();
    for (Eigen::Index k = 0; k < m.spectrum.size(); ++k)
      spectrum.push_back({m.spectrum[k].real(), m.spectrum[k].imag()});
    json[m.kind == MotionKind::equilibrium && !m.depends_on_angle ? "eigenvalues" : "multipliers"] = spectrum;
    json["residual"] = m.residual;
  }
  json["exponents"] = m.exponents;
  json["stable"] = m.stable;
  if (m.eventful) {
    json["lasting"] = text_of(m.mode, balls);
    json["events"] = events_json(m);
    json["stuck"] = m.stuck;
    json["continuum_of_friction"] = m.set_valued;
  }
  return json;
}

}  // namespace equipoise
