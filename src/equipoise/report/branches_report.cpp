// Branches as text, JSON and CSV.
#include "equipoise/report/branches_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "equipoise/base/version.hpp"
#include "equipoise/report/csv.hpp"
#include "equipoise/report/computed.hpp"
#include "equipoise/report/text.hpp"

namespace equipoise {

namespace {

using Json = nlohmann::ordered_json;

std::string title(const Branch& b) { return b.alias.empty() ? b.name : fmt::format("{} ({})", b.name, b.alias); }

// Digits that a bracket of this width supports.
std::string located(double value, double width) {
  if (!(width > 0.0)) return fmt::format("{:.12g}", value);
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(width))), 0, 12);
  return fmt::format("{:.{}f}", value, digits);
}

std::string event_text(const BranchEvent& e) { return located(e.middle(), e.high - e.low); }

// Where the branch's range ends, told as well as it is known.
std::string end_text(const Branch& branch, double value) {
  for (const BranchEvent& e : branch.events)
    if (e.middle() == value) return event_text(e);
  return fmt::format("{:.12g}", value);
}

std::string range_text(const Branch& branch, const ValueRange& range) {
  if (range.begin == range.end) return end_text(branch, range.begin);
  return fmt::format("{} to {}", end_text(branch, range.begin), end_text(branch, range.end));
}

std::string stable_text(const Branch& branch, const std::vector<ValueRange>& ranges) {
  std::string text;
  for (const ValueRange& range : ranges)
    if (range.stable) text += (text.empty() ? "" : ", ") + range_text(branch, range);
  return text.empty() ? "nowhere" : text;
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json point_json(const BranchPoint& point, int balls) {
  const Motion& m = point.motion;
  Json json = {{"value", point.value},
               {"kind", name_of(m.kind)},
               {"stable", m.stable},
               {"period", m.kind == MotionKind::periodic ? Json(m.period) : Json(nullptr)},
               {"radial", {{"min", m.r_min}, {"mean", m.r_mean}, {"max", m.r_max}}},
               {"multiplier", number(largest_multiplier(m))},
               {"growth_rate", number(growth_rate(m))},
               {"drift", std::vector<double>(m.drift.begin(), m.drift.begin() + balls)},
               {"state", std::vector<double>(m.state.data(), m.state.data() + m.state.size())}};
  if (!m.motor) return json;
  json["speed"] = {{"min", m.motor->speed_min}, {"mean", m.speed}, {"max", m.motor->speed_max}};
  json["torque"] = m.motor->torque;
  json["power"] = m.motor->power;
  return json;
}

}  // namespace

std::string branches_text(const BranchesResult& r) {
  std::string text = study_heading(r.study);
  text += fmt::format("along {} ({}): {:.12g} to {:.12g}, {} values\n\n", r.key, parameter_label(r.key),
                      r.values.front(), r.values.back(), r.values.size());
  constexpr const char* row = "{:>3}  {:<44}{:<24}{}\n";
  text += fmt::format(row, "id", "attractor", "exists", "attracts");
  for (const Branch& b : r.branches) {
    const auto ranges = ranges_of(b);
    text += fmt::format(row, b.id, title(b), range_text(b, {ranges.front().begin, ranges.back().end, true}),
                        stable_text(b, ranges));
  }
  constexpr const char* line = "{:>12}  {:<26}{:>3}  {:<44}{:<18}{}\n";
  text += "\n" + fmt::format(line, "at", "between", "id", "attractor", "event", "type");
  std::vector<std::pair<const BranchEvent*, const Branch*>> events;
  for (const Branch& b : r.branches)
    for (const BranchEvent& e : b.events) events.emplace_back(&e, &b);
  std::stable_sort(events.begin(), events.end(),
                   [](const auto& a, const auto& b) { return a.first->middle() < b.first->middle(); });
  for (const auto& [e, b] : events)
    text += fmt::format(line, event_text(*e), fmt::format("{:.9g} and {:.9g}", e->low, e->high), e->id, title(*b),
                        name_of(e->change), name_of(e->cause));
  if (events.empty()) text += "  none\n";
  text += fmt::format(
      "\nA range that begins at {:.12g} or ends at {:.12g} may go on beyond. Attractors that live between two values "
      "only, or that no pilot start meets, are not listed; states of one's own are followed too.\n",
      r.values.front(), r.values.back());
  if (r.partial) text += "PARTIAL: stopped before every branch was followed to its ends.\n";
  text += fmt::format("{:.1f} s on {} thread{} ({}); equipoise {}\n", r.seconds, r.threads, r.threads == 1 ? "" : "s",
                      r.cpu_target, version_string);
  return text;
}

std::string branches_json(const BranchesResult& r) {
  const int balls = r.study.parameters.balls;
  Json json = {{"parameter", r.key}, {"values", r.values}};
  json["branches"] = Json::array();
  json["events"] = Json::array();
  for (const Branch& b : r.branches) {
    const auto ranges = ranges_of(b);
    Json stable = Json::array(), points = Json::array();
    for (const ValueRange& range : ranges)
      if (range.stable) stable.push_back({range.begin, range.end});
    for (const BranchPoint& point : b.points) points.push_back(point_json(point, balls));
    json["branches"].push_back({{"id", b.id},
                                {"name", b.name},
                                {"alias", b.alias},
                                {"exists", {ranges.front().begin, ranges.back().end}},
                                {"stable", stable},
                                {"points", points}});
    for (const BranchEvent& e : b.events)
      json["events"].push_back({{"id", e.id},
                                {"change", name_of(e.change)},
                                {"type", name_of(e.cause)},
                                {"between", {e.low, e.high}},
                                {"radial", {{"min", e.r_min}, {"mean", e.r_mean}, {"max", e.r_max}}}});
  }
  json["partial"] = r.partial;
  add_computed(json, r);
  return json.dump(2) + "\n";
}

std::string branches_csv(const BranchesResult& r) {
  const int balls = r.study.parameters.balls;
  std::string text = fmt::format("# equipoise {}: attractors along {}{}\n", version_string, r.key,
                                 r.partial ? ", PARTIAL: stopped early" : "");
  text += csv_study(r.study);
  for (const Branch& b : r.branches)
    for (const BranchEvent& e : b.events)
      text += fmt::format("# event: id {}, {}, {}, between {} and {}\n", b.id, name_of(e.change), name_of(e.cause),
                          e.low, e.high);
  text += r.key + ",id,name,alias,kind,stable,period,r_min,r_mean,r_max,multiplier,growth_rate";
  for (int i = 1; i <= balls; ++i) text += fmt::format(",drift_{}", i);
  if (r.study.speed.driven()) text += ",speed,speed_min,speed_max,torque,power";
  text += "\n";
  for (std::size_t k = 0; k < r.values.size(); ++k) {
    for (const Branch& b : r.branches) {
      const auto at = std::find_if(b.points.begin(), b.points.end(), [&](const BranchPoint& p) { return p.at == k; });
      if (at == b.points.end()) continue;
      const Motion& m = at->motion;
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}", at->value, b.id, csv_text(b.name), b.alias,
                          name_of(m.kind), m.stable ? 1 : 0, m.kind == MotionKind::periodic ? csv_number(m.period) : "",
                          m.r_min, m.r_mean, m.r_max, csv_number(largest_multiplier(m)), csv_number(growth_rate(m)));
      for (int i = 0; i < balls; ++i) text += fmt::format(",{}", m.drift[i] + 0.0);
      if (m.motor)
        text += fmt::format(",{},{},{},{},{}", m.speed, m.motor->speed_min, m.motor->speed_max, m.motor->torque,
                            m.motor->power);
      text += "\n";
    }
  }
  return text;
}

}  // namespace equipoise
