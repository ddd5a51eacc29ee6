// Numbers and studies as text.
#include "equipoise/report/text.hpp"

#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include "equipoise/report/engineering.hpp"

namespace equipoise {

namespace {

using study::Dimension;

// A number of the study, in physical units where it has them.
class Shown {
 public:
  explicit Shown(const Study& study) : scales_(study.scales) {}

  std::string operator()(double value, Dimension d) const {
    return scales_ ? engineering(value * study::scale_of(d, *scales_), d) : fmt::format("{}", value);
  }
  // One for all, or one a ball; `factor` (in physical units only) times each value.
  std::string list(const double* values, const double* factor, int count, bool same, Dimension d) const {
    const auto entry = [&](int i) { return (*this)(scales_ && factor ? values[i] * factor[i] : values[i], d); };
    if (same) return entry(0);
    std::string text = "[";
    for (int i = 0; i < count; ++i) text += (i ? ", " : "") + entry(i);
    return text + "]";
  }

 private:
  const std::optional<model::Scales>& scales_;
};

std::string speed_text(const Study& study) {
  const SpeedSetting& s = study.speed;
  const Shown shown(study);
  const auto speed = [&](double value) { return shown(value, Dimension::speed); };
  const auto time = [&](double value) { return shown(value, Dimension::time); };
  std::string text;
  if (s.profile == "constant")
    text = fmt::format("constant speed {}", speed(s.speed));
  else if (s.profile == "ramp")
    text = fmt::format("ramp {} to {} in {}", speed(s.initial), speed(s.final), time(s.duration));
  else if (s.profile == "trapezoid")
    text = fmt::format("trapezoid {} to {} by {}, held to {}, to {} by {}", speed(s.initial), speed(s.peak),
                       time(s.rise_until), time(s.hold_until), speed(s.final), time(s.fall_until));
  else
    text = fmt::format("{} speed points to {} at {}", s.times.size(), speed(s.speeds.back()), time(s.times.back()));
  if (const double release = study.release_time(); release > 0.0)
    text += ", balls released at t = " + (study.scales ? time(release) : fmt::format("{:.6g}", release));
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
  const Shown shown(study);
  const bool same = p.equal_balls();
  text += fmt::format("{} ball{}: mass {}, drag {}; rotor: eccentricity {}, damping {}\n", p.balls,
                      p.balls == 1 ? "" : "s", shown.list(p.mass.data(), nullptr, p.balls, same, Dimension::mass),
                      shown.list(p.drag.data(), p.mass.data(), p.balls, same, Dimension::gain),
                      shown(p.eccentricity, Dimension::length), shown(p.damping[0], Dimension::damping));
  if (study.scales)
    text += fmt::format("critical speed {}; times below are in units of {}\n", shown(1.0, Dimension::speed),
                        shown(1.0, Dimension::time));
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
