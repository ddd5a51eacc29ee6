// Transients as text and as JSON.
#include "equipoise/text/transient_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "equipoise/mechanics/balance_grade.hpp"
#include "equipoise/model/stroboscopic_section.hpp"
#include "equipoise/text/text.hpp"
#include "equipoise/types/outcomes.hpp"

namespace equipoise {

namespace {

using Json = nlohmann::ordered_json;
using study::Dimension;

using Unit = study::ShownUnit;

Unit unit_of(const Study& study, Dimension d) { return study::shown_unit(d, study.scales); }
Unit unit_of(const Study& study, const TransientLimit& limit) { return unit_of(study, *limit.figure().dimension); }

constexpr const char* no_bound = "?";

std::string number(double value, double size, const char* open) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value * size) : open;
}

// With this many starts, the least and the largest figure enclose the median with 95 % confidence: 2^(1 - n) < .05.
constexpr std::uint64_t fewest_for_figures = 6;

std::string figure_line(const TransientFigure& f, const SampleSummary& s, const Unit& unit, const char* open_word) {
  const char* open = s.open > 0 ? open_word : no_bound;
  const auto with_interval = [&](double value, double low, double high) -> std::string {
    if (std::isinf(low)) return open;
    return fmt::format("{} ({} to {})", number(value, unit.size, open), number(low, unit.size, open),
                       number(high, unit.size, open));
  };
  const std::size_t unit_width = std::max<std::size_t>(15, std::string_view(unit.name).size() + 1);
  constexpr std::string_view above = "peak displacement ";  // in the previous line
  std::string title = f.title;
  if (title.starts_with(above)) title.replace(0, above.size(), "  ");
  std::string line = fmt::format("  {:<{}}{:<{}}", title, 45 - unit_width, unit.name, unit_width);
  if (s.open == 0 && s.mean_low == s.mean_high)  // one motion
    return line + fmt::format("{}, the same for all starts\n", number(s.mean, unit.size, open));
  line += fmt::format("{:<36}", s.open == s.count ? open : with_interval(s.mean, s.mean_low, s.mean_high));
  for (const QuantileEstimate& q : s.quantiles) line += fmt::format("{:<36}", with_interval(q.value, q.low, q.high));
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string group_text(const TransientGroup& group, const TransientResult& r, const Study& study) {
  const std::string name = group.id ? group.name : "all outcomes";
  if (group.starts < fewest_for_figures)
    return fmt::format("{}: too few starts ({}) for figures\n", name, group.starts);
  std::string text = fmt::format("{}, {} starts\n", name, group.starts);
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    const TransientFigure& f = transient_figures[k];
    if (!r.asks(f, study.limits) || f.value == &TransientRow::followed_until) continue;
    const SampleSummary& s = group.figures[k];
    const Unit unit = unit_of(study, f.told_in());
    if (s.open == 0) {
      text += figure_line(f, s, unit, no_bound);
      continue;
    }
    const std::uint64_t for_good = group.for_good(f), later = s.open - for_good;
    text += figure_line(f, s, unit, later == 0 ? f.open[0] : for_good == 0 ? f.open[1] : "no end seen");
    std::string words;
    if (for_good > 0) words = fmt::format("{}: {} of {} starts", f.open[0], for_good, s.count);
    if (later > 0)
      words +=
          fmt::format("{}{} when last followed: {} of {} starts", words.empty() ? "" : "; ", f.open[1], later, s.count);
    text += fmt::format("    {}{}\n", words, s.open < s.count ? "; the mean is of the others" : "");
  }
  for (std::size_t k = 0; k < transient_limits.size(); ++k) {
    if (!group.exceeded[k]) continue;
    const TransientLimit& l = transient_limits[k];
    const Share& s = *group.exceeded[k];
    const Unit unit = unit_of(study, l);
    text += fmt::format(
        "  {} {} above {:.4g} {}: {} ({}){}\n", l.at_end ? "RMS" : "peak", l.name, *(study.limits.*l.limit) * unit.size,
        unit.name, percent(s.share, s.count == 0 ? 0 : digits_for(s)), interval(s),
        group.id != undecided_code && (s.least < s.low || s.most > s.high) ? "; surely " + bounds_text(s) : "");
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
  const double mean = group.figure(&TransientRow::residual_unbalance).mean;
  const std::optional<double> speed =
      study.speed.driven() ? group.mean_speed : std::optional(study.speed_profile().final_speed());
  if (!speed) return std::nullopt;
  return model::balance_grade(mean * study.scales->length, *speed * study.scales->frequency);
}

std::string transient_text(const TransientResult& r, const Study& study) {
  const Unit length = unit_of(study, Dimension::length), time = unit_of(study, Dimension::time),
             force = unit_of(study, Dimension::force);
  std::string text = fmt::format("  {:<45}{:<36}{:<36}{:<36}{}\n", "transients (95 % intervals)", "mean", "median",
                                 "90 % of starts below", "99 % of starts below");
  for (const TransientGroup& group : r.groups)
    // A single outcome says everything.
    if (group.starts > 0 && !(!group.id && r.groups.size() == 2)) text += group_text(group, r, study);
  if (r.settings.watches_settling())
    text += fmt::format("Settled: displacement below {:.4g} {}.\n", r.settings.settled * length.size, length.name);
  const bool undecided =
      std::any_of(r.groups.begin(), r.groups.end(), [](const auto& g) { return g.id == undecided_code; });
  text += fmt::format("\n\"At the end\": of the steady motion that a start comes to{}.\n",
                      undecided ? fmt::format("; of an undecided start in its last window of {:.4g} {}",
                                              r.settings.window * time.size, time.name)
                                : "");
  text += "RMS velocity: of both directions together; one alone has about 0.71 of it.\n";
  const double sag = -model::static_sag(study.parameters);
  if (sag != 0.0)
    text += fmt::format(
        "Displacements count from where the rotor rests, {:.4g} {} below slack springs; bearing forces hold its "
        "weight, "
        "{:.4g} {}.\n",
        sag * length.size, length.name, sag * study.parameters.stiffness[1] * force.size, force.name);
  if (r.lost > 0) text += fmt::format("{} starts diverged or failed and are left out here.\n", r.lost);
  return text + "\n";
}

nlohmann::ordered_json transient_json(const TransientResult& r, const Study& study) {
  const Unit length = unit_of(study, Dimension::length), time = unit_of(study, Dimension::time);
  Json json;
  for (const TransientLimit& l : transient_limits) json["units"][l.name] = unit_of(study, l).name;
  json["units"]["time"] = time.name;
  json["units"]["energy"] = unit_of(study, Dimension::energy).name;
  json["window"] = r.settings.window * time.size;
  const double sag = 0.0 - model::static_sag(study.parameters);
  json["static_sag"] = sag * length.size;
  json["weight"] = sag * study.parameters.stiffness[1] * unit_of(study, Dimension::force).size;
  json["limits"] = Json::object();
  for (const TransientLimit& l : transient_limits)
    if (const auto& limit = study.limits.*l.limit) json["limits"][l.name] = *limit * unit_of(study, l).size;
  if (r.settings.watches_settling()) json["limits"]["settled"] = r.settings.settled * length.size;
  json["lost"] = r.lost;
  json["groups"] = Json::array();
  for (const TransientGroup& group : r.groups) {
    Json one = {{"name", group.name}, {"id", group.id ? Json(*group.id) : Json(nullptr)}, {"starts", group.starts}};
    for (std::size_t k = 0; k < transient_figures.size(); ++k) {
      const TransientFigure& f = transient_figures[k];
      if (!r.asks(f, study.limits)) continue;
      Json& figure = one["figures"][f.name] = figure_json(group.figures[k], unit_of(study, f.told_in()));
      if (f.needs) figure["for_good"] = group.for_good(f);
    }
    one["exceeded"] = Json::object();
    for (std::size_t k = 0; k < transient_limits.size(); ++k)
      if (const auto& share = group.exceeded[k]) one["exceeded"][transient_limits[k].name] = sure_share_json(*share);
    const std::optional<double> grade = left_grade(group, study);
    if (grade) one["balance_grade"] = *grade;
    if (group.mean_speed) one["mean_speed"] = *group.mean_speed;
    json["groups"].push_back(one);
  }
  return json;
}

}  // namespace equipoise
