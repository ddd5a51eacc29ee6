// The answer of an ensemble as text and as JSON.
#include "equipoise/report/basin_result.hpp"

#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include "equipoise/base/version.hpp"

namespace equipoise {

namespace {

using Json = nlohmann::ordered_json;

// Percent with as many digits as the interval supports.
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

Json share_json(const Share& s) { return {{"count", s.count}, {"share", s.share}, {"low", s.low}, {"high", s.high}}; }

Json study_json(const Study& study) {
  std::ostringstream text;
  text << toml::json_formatter{toml::parse(to_toml(study))};
  return Json::parse(text.str());
}

}  // namespace

std::string basin_text(const BasinResult& r) {
  const model::Parameters& p = r.study.parameters;
  std::string text = fmt::format("{}\n", r.study.name);
  text += fmt::format("{} ball{}: mass {}, drag {}; rotor: eccentricity {}, damping {}\n", p.balls,
                      p.balls == 1 ? "" : "s", list(p.mass.data(), p.balls, p.equal_balls()),
                      list(p.drag.data(), p.balls, p.equal_balls()), p.eccentricity, p.damping[0]);
  text += speed_text(r.study) + "\n\n";
  text += fmt::format("{:<14}{:>11}  {:<24}{:>11}{:>13}\n", "outcome", "share", "95 % interval", "starts", "mean time");
  for (int k = 0; k < outcome_count; ++k) {
    const Share& s = r.shares[k];
    const std::string share = s.total == 0 ? "-" : percent(s.share, s.count == 0 ? 0 : digits_for(s));
    const std::string time = s.count == 0 ? "-" : fmt::format("{:.1f}", r.mean_time[k]);
    text += fmt::format("{:<14}{:>11}  {:<24}{:>11}{:>13}\n", outcome_names[k], share, interval(s), s.count, time);
  }
  text += "\n";
  if (!r.note.empty()) text += fmt::format("Note: {}.\n", r.note);
  if (r.partial) text += "PARTIAL: stopped before all starts were done; the shares above are of those that were.\n";
  text += fmt::format("{} starts, seed {}; {:.2f} s, {:.2f} s CPU on {} thread{} ({}), {:.0f} starts/s; equipoise {}\n",
                      r.starts, r.study.sampling.seed, r.seconds, r.cpu_seconds, r.threads, r.threads == 1 ? "" : "s",
                      r.cpu_target, static_cast<double>(r.starts - r.resumed_from) / r.seconds, version_string);
  return text;
}

std::string basin_json(const BasinResult& r) {
  const auto outcome = [&](Outcome kind, int id) {
    const auto k = static_cast<std::size_t>(kind);
    Json json = {{"id", id}, {"name", outcome_names[k]}, {"alias", ""}};
    json.update(share_json(r.shares[k]));
    json["mean_time"] = r.mean_time[k];
    return json;
  };
  Json json;
  json["starts"] = r.starts;
  json["partial"] = r.partial;
  json["outcomes"] = {outcome(Outcome::balanced, 1), outcome(Outcome::not_balanced, 0)};
  json["undecided"] = share_json(r.shares[static_cast<std::size_t>(Outcome::undecided)]);
  json["diverged"] = share_json(r.shares[static_cast<std::size_t>(Outcome::diverged)]);
  json["failed"] = share_json(r.shares[static_cast<std::size_t>(Outcome::failed)]);
  json["confidence"] = 0.95;
  json["balanced_stable"] = r.balanced_stable;
  json["note"] = r.note;
  json["seconds"] = r.seconds;
  json["cpu_seconds"] = r.cpu_seconds;
  json["starts_per_second"] = r.seconds > 0.0 ? static_cast<double>(r.starts - r.resumed_from) / r.seconds : 0.0;
  json["resumed_from"] = r.resumed_from;
  json["threads"] = r.threads;
  json["cpu_target"] = r.cpu_target;
  json["law"] = r.study.speed.law == model::SpeedLaw::published ? "published" : "kinematic";
  json["study_name"] = r.study.name;
  json["study"] = study_json(r.study);
  json["version"] = version_string;
  return json.dump(2) + "\n";
}

}  // namespace equipoise
