// Reads the JSON and the text that people and programs get.
#include "equipoise/core/base/angles.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace equipoise::audit {

namespace {

using Json = nlohmann::json;

std::optional<double> number(const Json& json, const char* key) {
  const auto at = json.find(key);
  if (at == json.end() || !at->is_number()) return std::nullopt;
  return at->get<double>();
}

void check_share(const Json& share, const std::string& name, double starts, std::vector<std::string>& faults) {
  const auto p = number(share, "share"), low = number(share, "low"), high = number(share, "high");
  if (!p || !low || !high || !(0.0 <= *low && *low <= *p && *p <= *high && *high <= 1.0))
    faults.push_back(fmt::format("share of {} outside its interval: {}", name, share.dump()));
  const auto count = number(share, "count");
  if (!count || *count < 0.0 || *count > starts) faults.push_back(fmt::format("count of {}: {}", name, share.dump()));
}

void check_transients(const Json& transients, std::vector<std::string>& faults) {
  for (const Json& group : transients.at("groups")) {
    const std::string name = group.at("name");
    std::map<std::string, double> largest;
    for (const auto& [key, figure] : group.at("figures").items()) {
      for (const char* what : {"mean", "largest"})
        if (const auto value = number(figure, what); value && !(*value >= 0.0))
          faults.push_back(fmt::format("{} of {}: {} is {}", key, name, what, *value));
      if (const auto value = number(figure, "largest")) largest[key] = *value;
      double before = 0.0;
      for (const Json& q : figure.at("quantiles")) {
        const auto value = number(q, "value");
        if (!value) continue;
        if (*value < before) faults.push_back(fmt::format("quantiles of {} of {} fall", key, name));
        before = *value;
      }
    }
    const auto above = [&](const char* more, const char* less) {
      // Rounding of single precision.
      if (largest.count(more) && largest.count(less) && largest[less] > largest[more] * (1.0 + 1e-6))
        faults.push_back(
            fmt::format("{}: largest {} {} exceeds {} {}", name, less, largest[less], more, largest[more]));
    };
    above("peak_radial", "peak_radial_after_release");
    above("peak_radial_after_release", "peak_radial_at_end");
    above("peak_force", "rms_force");
    above("followed_until", "settling_time");
    above("followed_until", "time_above");
  }
}

}  // namespace

std::vector<std::string> impossible_figures(const BasinResult& result) {
  std::vector<std::string> faults;
  const std::string object_text = json_text(result), text = basin_text(result);
  for (const char* word : {"nan", "inf ", "-0.0 %", "-0 %"})
    if (text.find(std::string(" ") + word) != std::string::npos)
      faults.push_back(fmt::format("the text holds \"{}\"", word));
  const Json json = Json::parse(object_text);
  const double starts = json.at("starts");
  double sum = 0.0;
  const auto add = [&](const Json& share, const std::string& name) {
    check_share(share, name, starts, faults);
    sum += number(share, "count").value_or(0.0);
  };
  for (const Json& outcome : json.at("outcomes")) {
    add(outcome, outcome.at("name"));
    const auto time = number(outcome, "mean_time");
    if (outcome.at("count") > 0 && (!time || !(*time >= 0.0)))
      faults.push_back(fmt::format("mean time of {} is {}", outcome.at("name").dump(), outcome.at("mean_time").dump()));
  }
  for (const char* word : {"undecided", "diverged", "failed", "stalled"})
    if (json.contains(word)) add(json.at(word), word);
  if (sum != starts) faults.push_back(fmt::format("outcomes of {} starts sum to {}", starts, sum));
  if (json.contains("transients")) check_transients(json.at("transients"), faults);
  return faults;
}

std::vector<std::string> wrong_units(const BasinResult& dimensionless, const BasinResult& physical) {
  std::vector<std::string> faults;
  const Json a = Json::parse(json_text(dimensionless)), b = Json::parse(json_text(physical));
  if (!a.contains("transients") || !b.contains("transients")) return {"no transients where they were asked for"};
  const model::Scales& u = *physical.study.scales;
  const std::map<std::string, double> units{
      {"mm", 1e3 * u.length}, {"N", u.force()},  {"mm/s", 1e3 * u.velocity()},    {"s", u.time()},
      {"ms", 1e3 * u.time()}, {"J", u.torque()}, {"rpm", u.frequency * 30.0 / pi}};
  // Quantiles: a start or two that a rounding sends elsewhere change a mean by much. A wrong unit moves all of them,
  // while a rounding that changes when outcomes are known moves the energy taken until then for some starts only.
  const auto quantiles = [](const Json& figure) {
    std::vector<std::optional<double>> values;
    for (const Json& q : figure.value("quantiles", Json::array())) values.push_back(number(q, "value"));
    return values;
  };
  // What remains in a balanced rotor is rounding: 1e-5 of a unit.
  const auto least = [&](const std::string& unit) { return 1e-5 * units.at(unit); };
  constexpr double apart = 0.05;
  const Json& first = a["transients"]["groups"][0]["figures"];
  for (const auto& [key, figure] : b["transients"]["groups"][0]["figures"].items()) {
    const std::string unit = figure.value("unit", "");
    const auto at = units.find(unit);
    if (at == units.end()) {
      faults.push_back(fmt::format("{} is in \"{}\"", key, unit));
      continue;
    }
    const auto xs = quantiles(first.value(key, Json::object())), ys = quantiles(figure);
    std::string differ;
    bool agree = false;
    for (std::size_t k = 0; k < std::min(xs.size(), ys.size()); ++k) {
      if (!xs[k] || !ys[k]) continue;
      const double x = *xs[k], y = *ys[k];
      agree = agree || std::fabs(y - x * at->second) <= apart * std::fabs(y) + least(unit);
      differ += fmt::format("{}{:.4g} {} instead of {:.4g}", differ.empty() ? "" : ", ", y, unit, x * at->second);
    }
    if (!differ.empty() && !agree) faults.push_back(fmt::format("quantiles of {} are {}", key, differ));
  }
  return faults;
}

}  // namespace equipoise::audit
