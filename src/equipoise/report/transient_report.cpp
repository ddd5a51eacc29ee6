// Transients as text and as JSON.
#include "equipoise/report/transient_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "equipoise/model/balance_grade.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/report/text.hpp"

namespace equipoise {

namespace {

using Json = nlohmann::ordered_json;

struct Unit {
  const char* name;
  double size;  // in it, of the dimensionless unit
};
struct Units {
  Unit displacement, force, velocity, time, energy;
};

Units units_of(const Study& study) {
  if (!study.scales)
    return {{"R", 1.0}, {"M R omega_c^2", 1.0}, {"R omega_c", 1.0}, {"1/omega_c", 1.0}, {"M R^2 omega_c^2", 1.0}};
  const model::Scales& s = *study.scales;
  return {
      {"mm", 1000.0 * s.length}, {"N", s.force()}, {"mm/s", 1000.0 * s.velocity()}, {"s", s.time()}, {"J", s.torque()}};
}

// How a column is told. `open`: words for a figure without end: of a motion that exceeds the limit for good, of a start
// that had not come below it when it was last followed; `for_good` counts the former.
struct Told {
  float TransientRow::*value;
  const char* title;
  Unit Units::*unit;
  std::array<const char*, 2> open{"?", "?"};
  std::uint64_t TransientGroup::*for_good = nullptr;
};
constexpr const char* no_bound = "?";
constexpr std::array<Told, transient_columns.size()> told{{
    {&TransientRow::peak_radial, "peak displacement", &Units::displacement},
    {&TransientRow::peak_radial_after_release, "  after release", &Units::displacement},
    {&TransientRow::peak_radial_at_end, "  at the end", &Units::displacement},
    {&TransientRow::peak_force, "peak bearing force", &Units::force},
    {&TransientRow::rms_force, "RMS bearing force at the end", &Units::force},
    {&TransientRow::rms_velocity, "RMS velocity at the end", &Units::velocity},
    {&TransientRow::residual_unbalance, "residual unbalance U/M", &Units::displacement},
    {&TransientRow::time_above,
     "time above the limit",
     &Units::time,
     {"lasting", "not over"},
     &TransientGroup::lasting},
    {&TransientRow::settling_time, "settling time", &Units::time, {"never", "not yet"}, &TransientGroup::never},
    {&TransientRow::energy, "work of the drive", &Units::energy},
    {&TransientRow::followed_until, "followed until", &Units::time},
}};

std::size_t column_of(float TransientRow::*value) {
  std::size_t k = 0;
  while (transient_columns[k].value != value) ++k;
  return k;
}

bool applies(const Told& t, const TransientSettings& settings) {
  if (t.value == &TransientRow::time_above) return std::isfinite(settings.displacement);
  if (t.value == &TransientRow::energy) return settings.work != WorkSource::none;
  return t.value != &TransientRow::settling_time || settings.watches_settling();
}

std::array<std::optional<double>, 3> limits_of(const Study& study) {
  return {study.limits.displacement, study.limits.force, study.limits.velocity};
}
constexpr std::array<Unit Units::*, 3> limit_units{&Units::displacement, &Units::force, &Units::velocity};

std::string number(double value, double size, const char* open) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value * size) : open;
}

// Fewest starts whose least and largest figure hold the median between them with 95 % confidence: 2^(1 - n) < .05.
constexpr std::uint64_t fewest_for_figures = 6;

std::string figure_line(const Told& t, const SampleSummary& s, const Unit& unit, const char* open_word) {
  const char* open = s.open > 0 ? open_word : no_bound;
  const auto with_interval = [&](double value, double low, double high) -> std::string {
    if (std::isinf(low)) return open;
    return fmt::format("{} ({} to {})", number(value, unit.size, open), number(low, unit.size, open),
                       number(high, unit.size, open));
  };
  const std::size_t unit_width = std::max<std::size_t>(15, std::string_view(unit.name).size() + 1);
  std::string line = fmt::format("  {:<{}}{:<{}}", t.title, 45 - unit_width, unit.name, unit_width);
  if (s.open == 0 && s.mean_low == s.mean_high)  // of one motion
    return line + fmt::format("{}, the same for all starts\n", number(s.mean, unit.size, open));
  line += fmt::format("{:<36}", s.open == s.count ? open : with_interval(s.mean, s.mean_low, s.mean_high));
  for (const QuantileEstimate& q : s.quantiles) line += fmt::format("{:<36}", with_interval(q.value, q.low, q.high));
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string group_text(const TransientGroup& group, const TransientResult& r, const Study& study, const Units& units) {
  const std::string name = group.name == "all" ? "all outcomes" : group.name;
  if (group.starts < fewest_for_figures)
    return fmt::format("{}: too few starts ({}) for figures\n", name, group.starts);
  std::string text = fmt::format("{}, {} starts\n", name, group.starts);
  for (const Told& t : told) {
    if (!applies(t, r.settings) || t.value == &TransientRow::followed_until) continue;
    const SampleSummary& s = group.figures[column_of(t.value)];
    if (s.open == 0) {
      text += figure_line(t, s, units.*t.unit, no_bound);
      continue;
    }
    const std::uint64_t for_good = group.*t.for_good, later = s.open - for_good;
    text += figure_line(t, s, units.*t.unit, later == 0 ? t.open[0] : for_good == 0 ? t.open[1] : "no end seen");
    std::string words;
    if (for_good > 0) words = fmt::format("{}: {} of {} starts", t.open[0], for_good, s.count);
    if (later > 0)
      words +=
          fmt::format("{}{} when last followed: {} of {} starts", words.empty() ? "" : "; ", t.open[1], later, s.count);
    text += fmt::format("    {}{}\n", words, s.open < s.count ? "; the mean is of the others" : "");
  }
  const auto limits = limits_of(study);
  for (std::size_t k = 0; k < limits.size(); ++k) {
    if (!group.exceeded[k]) continue;
    const Share& s = *group.exceeded[k];
    const Unit& unit = units.*limit_units[k];
    text +=
        fmt::format("  {} {} above {:.4g} {}: {} ({}){}\n", k == 2 ? "RMS" : "peak", transient_limit_names[k],
                    *limits[k] * unit.size, unit.name, percent(s.share, s.count == 0 ? 0 : digits_for(s)), interval(s),
                    group.id != 0 && (s.least < s.low || s.most > s.high) ? "; surely " + bounds_text(s) : "");
  }
  const std::optional<double> grade = left_grade(group, study);
  if (grade)
    text += fmt::format("  residual unbalance at the final speed: e omega = {:.3g} mm/s (as ISO 21940-11 grades it)\n",
                        *grade);
  return text;
}

Json json_number(double value, double size) { return std::isfinite(value) ? Json(value * size) : Json(nullptr); }

Json figure_json(const SampleSummary& s, const Unit& unit) {
  Json one = {{"unit", unit.name}, {"count", s.count}, {"open", s.open}};
  const bool some = s.open < s.count;
  one["mean"] = some ? json_number(s.mean, unit.size) : Json(nullptr);
  one["mean_low"] = some ? json_number(s.mean_low, unit.size) : Json(nullptr);
  one["mean_high"] = some ? json_number(s.mean_high, unit.size) : Json(nullptr);
  one["largest"] = json_number(s.largest, unit.size);
  one["quantiles"] = Json::array();
  for (std::size_t k = 0; k < s.quantiles.size(); ++k)
    one["quantiles"].push_back({{"probability", reported_quantiles[k]},
                                {"value", json_number(s.quantiles[k].value, unit.size)},
                                {"low", json_number(s.quantiles[k].low, unit.size)},
                                {"high", json_number(s.quantiles[k].high, unit.size)}});
  one["exact"] = s.exact;
  return one;
}

}  // namespace

std::optional<double> left_grade(const TransientGroup& group, const Study& study) {
  if (!study.scales) return std::nullopt;
  const double mean = group.figures[column_of(&TransientRow::residual_unbalance)].mean;
  const std::optional<double> speed =
      study.speed.driven() ? group.mean_speed : std::optional(study.speed_profile().final_speed());
  if (!speed) return std::nullopt;
  return model::balance_grade(mean * study.scales->length, *speed * study.scales->frequency);
}

std::string transient_text(const TransientResult& r, const Study& study) {
  const Units units = units_of(study);
  std::string text = fmt::format("  {:<45}{:<36}{:<36}{:<36}{}\n", "transients (95 % intervals)", "mean", "median",
                                 "90 % of starts below", "99 % of starts below");
  for (const TransientGroup& group : r.groups)
    // A single outcome says all.
    if (group.starts > 0 && !(group.name == "all" && r.groups.size() == 2)) text += group_text(group, r, study, units);
  if (r.settings.watches_settling())
    text += fmt::format("Settled: displacement below {:.4g} {}.\n", r.settings.settled * units.displacement.size,
                        units.displacement.name);
  const bool undecided = std::any_of(r.groups.begin(), r.groups.end(), [](const auto& g) { return g.id == 0; });
  text += fmt::format("\n\"At the end\": of the steady motion that a start comes to{}.\n",
                      undecided ? fmt::format("; of an undecided start in its last window of {:.4g} {}",
                                              r.settings.window * units.time.size, units.time.name)
                                : "");
  text += "RMS velocity: of both directions together; one alone has about 0.71 of it.\n";
  const double sag = -model::static_sag(study.parameters);
  if (sag != 0.0)
    text += fmt::format(
        "Displacements count from where the rotor rests, {:.4g} {} below slack springs; bearing forces hold its "
        "weight, "
        "{:.4g} {}.\n",
        sag * units.displacement.size, units.displacement.name, sag * study.parameters.stiffness[1] * units.force.size,
        units.force.name);
  if (r.lost > 0) text += fmt::format("{} starts diverged or failed and are left out here.\n", r.lost);
  return text + "\n";
}

nlohmann::ordered_json transient_json(const TransientResult& r, const Study& study) {
  const Units units = units_of(study);
  Json json;
  json["units"] = {{"displacement", units.displacement.name},
                   {"force", units.force.name},
                   {"velocity", units.velocity.name},
                   {"time", units.time.name},
                   {"energy", units.energy.name}};
  json["window"] = r.settings.window * units.time.size;
  const double sag = 0.0 - model::static_sag(study.parameters);
  json["static_sag"] = sag * units.displacement.size;
  json["weight"] = sag * study.parameters.stiffness[1] * units.force.size;
  json["limits"] = Json::object();
  const auto limits = limits_of(study);
  for (std::size_t k = 0; k < limits.size(); ++k)
    if (limits[k]) json["limits"][transient_limit_names[k]] = *limits[k] * (units.*limit_units[k]).size;
  if (r.settings.watches_settling()) json["limits"]["settled"] = r.settings.settled * units.displacement.size;
  json["lost"] = r.lost;
  json["groups"] = Json::array();
  for (const TransientGroup& group : r.groups) {
    Json one = {{"name", group.name}, {"id", group.id < 0 ? Json(nullptr) : Json(group.id)}, {"starts", group.starts}};
    for (const Told& t : told) {
      const std::size_t k = column_of(t.value);
      if (!applies(t, r.settings)) continue;
      Json& figure = one["figures"][transient_columns[k].name] = figure_json(group.figures[k], units.*t.unit);
      if (t.for_good) figure["for_good"] = group.*t.for_good;
    }
    one["exceeded"] = Json::object();
    for (std::size_t k = 0; k < limits.size(); ++k)
      if (const auto& share = group.exceeded[k]) one["exceeded"][transient_limit_names[k]] = sure_share_json(*share);
    const std::optional<double> grade = left_grade(group, study);
    if (grade) one["balance_grade"] = *grade;
    if (group.mean_speed) one["mean_speed"] = *group.mean_speed;
    json["groups"].push_back(one);
  }
  return json;
}

}  // namespace equipoise
