// Numbers and studies as text.
#include "equipoise/report/text.hpp"

#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

namespace equipoise {

namespace {

std::string list(const double* values, int count, bool same) {
  if (same) return fmt::format("{}", values[0]);
  std::string text = "[";
  for (int i = 0; i < count; ++i) text += fmt::format("{}{}", i ? ", " : "", values[i]);
  return text + "]";
}

std::string speed_text(const Study& study) {
  const SpeedSetting& s = study.speed;
  std::string text;
  if (s.profile == "constant")
    text = fmt::format("constant speed {}", s.speed);
  else if (s.profile == "ramp")
    text = fmt::format("ramp {} to {} in {}", s.initial, s.final, s.duration);
  else if (s.profile == "trapezoid")
    text = fmt::format("trapezoid {} to {} by {}, held to {}, to {} by {}", s.initial, s.peak, s.rise_until,
                       s.hold_until, s.final, s.fall_until);
  else
    text = fmt::format("{} speed points to {} at {}", s.times.size(), s.speeds.back(), s.times.back());
  if (const double release = study.release_time(); release > 0.0)
    text += fmt::format(", balls released at t = {:.6g}", release);
  if (s.profile != "constant")
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
  return text + speed_text(study) + "\n\n";
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
