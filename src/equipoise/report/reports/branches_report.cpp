// Branches as a document, JSON and CSV.
#include "equipoise/report/reports/reports.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/text/motion_words.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/csv.hpp"
#include "equipoise/results/commands/motion_table.hpp"
#include "equipoise/results/commands/outcome_share.hpp"

namespace equipoise {

namespace {

int digits_of(double width) { return std::clamp(static_cast<int>(std::ceil(-std::log10(width))), 0, 12); }

// The number with the fewest digits between the bounds, but with as many digits as they support.
std::string located(double low, double high) {
  const double middle = 0.5 * (low + high);
  if (!(high > low)) return fmt::format("{:.12g}", middle);
  for (int digits = std::max(digits_of(high - low) - 1, 0); digits < 12; ++digits) {
    std::string text = fmt::format("{:.{}f}", middle, digits);
    if (const double value = number_in(text); value >= low && value <= high) return text;
  }
  return fmt::format("{:.12f}", middle);
}

// Rounded down or up to these digits; a number that already has no more digits stays.
std::string rounded_down(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  return fmt::format("{:.{}f}", std::floor(value * scale + 1e-6) / scale, digits);
}
std::string rounded_up(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  return fmt::format("{:.{}f}", std::ceil(value * scale - 1e-6) / scale, digits);
}

std::string event_text(const BranchEvent& e) {
  if (!(e.high > e.low)) return fmt::format("{:.12g}", e.middle());
  const int digits = digits_of(e.high - e.low);
  if (e.change == BranchChange::first_seen) return rounded_up(e.high, digits);
  if (e.change == BranchChange::last_seen) return rounded_down(e.low, digits);
  return located(e.low, e.high);
}

std::string bracket_text(const BranchEvent& e) {
  if (!(e.high > e.low)) return fmt::format("{:.12g}", e.middle());
  const int digits = std::min(digits_of(e.high - e.low) + 1, 12);
  return fmt::format("{} and {}", rounded_down(e.low, digits), rounded_up(e.high, digits));
}

// Where the branch's range ends, as exactly as known.
std::string end_text(const Branch& branch, double value) {
  for (const BranchEvent& e : branch.events)
    if (e.place() == value) return event_text(e);
  return fmt::format("{:.12g}", value);
}

std::string range_text(const Branch& branch, const ValueRange& range) {
  if (range.begin == range.end) return end_text(branch, range.begin);
  return fmt::format("{} to {}", end_text(branch, range.begin), end_text(branch, range.end));
}

bool has_event(const Branch& branch, BranchChange change) {
  return std::any_of(branch.events.begin(), branch.events.end(),
                     [&](const BranchEvent& e) { return e.change == change; });
}

// Whether the branch begins, or ends, for a known reason or at the line's end.
bool begin_is_known(const BranchesResult& r, const Branch& branch) {
  return has_event(branch, BranchChange::birth) ||
         (branch.points.front().value == r.values.front() && !has_event(branch, BranchChange::first_seen));
}
bool end_is_known(const BranchesResult& r, const Branch& branch) {
  return has_event(branch, BranchChange::death) ||
         (branch.points.back().value == r.values.back() && !has_event(branch, BranchChange::last_seen));
}

std::string existence_text(const BranchesResult& r, const Branch& branch) {
  const auto ranges = ranges_of(branch);
  const ValueRange whole{ranges.front().begin, ranges.back().end, true};
  const bool begin = begin_is_known(r, branch), end = end_is_known(r, branch);
  if (begin && end) return range_text(branch, whole);
  const char* where = begin ? " above" : end ? " below" : "";
  return fmt::format("seen {}{}, not followed further{}", whole.begin == whole.end ? "at " : "from ",
                     range_text(branch, whole), where);
}

std::string stable_text(const Branch& branch, const std::vector<ValueRange>& ranges) {
  std::string text;
  for (const ValueRange& range : ranges)
    if (range.stable) text += (text.empty() ? "" : ", ") + range_text(branch, range);
  return text.empty() ? "nowhere" : text;
}

}  // namespace

void to_json(Json& json, const PartOf<BranchPoint, Study>& of) {
  const Motion& m = of.part.motion;
  json = object("value", of.part.value, "kind", name_of(m.kind), "stable", m.stable, "period",
                motion_number("period").value(m), "radial", extremes(m.r_min, m.r_mean, m.r_max), "multiplier",
                largest_multiplier(m), "growth_rate", growth_rate(m), "drift",
                leading(m.drift, of.whole.parameters.balls), "state", leading(m.state, m.state.size()));
  if (m.motor)
    put(json, "speed", extremes(m.motor->speed_min, m.speed, m.motor->speed_max), "torque", m.motor->torque, "power",
        m.motor->power);
}

void to_json(Json& json, const BranchEvent& e) {
  json = object("id", e.id, "change", name_of(e.change), "type", name_of(e.cause), "between", std::array{e.low, e.high},
                "radial", extremes(e.r_min, e.r_mean, e.r_max));
}

Document document_of(const BranchesResult& r) {
  const std::string label = parameter_label(r.key);
  const std::string key = label == r.key ? r.key : fmt::format("{} ({})", r.key, label);
  Document document = document_with(
      r.study, "",
      fmt::format("along {}: {:.12g} to {:.12g}, {} values", key, r.values.front(), r.values.back(), r.values.size()));
  const bool physical = r.study.scales.has_value();
  DocumentTable branches{{"id", "attractor", "exists", "attracts"}};
  for (const Branch& b : r.branches)
    branches.rows.push_back(row_of("nttt", {fmt::format("{}", b.id), reader_title(b, physical), existence_text(r, b),
                                            stable_text(b, ranges_of(b))}));
  std::vector<std::pair<const BranchEvent*, const Branch*>> events;
  for (const Branch& b : r.branches)
    for (const BranchEvent& e : b.events) events.emplace_back(&e, &b);
  std::stable_sort(events.begin(), events.end(),
                   [](const auto& a, const auto& b) { return a.first->middle() < b.first->middle(); });
  DocumentTable table{{"at", "between", "id", "attractor", "event", "type"}};
  for (const auto& [e, b] : events)
    table.rows.push_back(row_of("ntnttt", {event_text(*e), bracket_text(*e), fmt::format("{}", e->id),
                                           reader_title(*b, physical), name_of(e->change), name_of(e->cause)}));
  table.spare = {2, 5, 1};
  if (events.empty()) table.rows.push_back(row_of("tttttt", {"none", "", "", "", "", ""}));
  document.add(branch_drawing(r));
  document.add(std::move(branches));
  document.add(std::move(table));
  document.add(Paragraph{fmt::format(
      "A range that begins at {:.12g} or ends at {:.12g} may continue beyond it. At every value and half-way "
      "between, {} random starts and the pilot were searched. Attractors to which fewer come are not listed, nor those "
      "that exist only between two of these values. States that you give are also followed.",
      r.values.front(), r.values.back(), r.starts)});
  if (r.partial)
    document.add(Paragraph{
        "PARTIAL: stopped before every branch was followed to its ends; there may be others, and events beyond.",
        Tone::bad});
  document.add(Paragraph{fmt::format("{:.1f} s on {} thread{} ({}); equipoise {}", r.seconds, r.threads,
                                     plural(r.threads), r.cpu_target, version_string)});
  return document;
}

std::string json_text(const BranchesResult& r) {
  Json branches = Json::array(), events = Json::array();
  for (const Branch& b : r.branches) {
    const auto ranges = ranges_of(b);
    Json stable = Json::array();
    for (const ValueRange& range : ranges)
      if (range.stable) stable.push_back({range.begin, range.end});
    branches.push_back(object("id", b.id, "name", b.name, "alias", b.alias, "exists",
                              std::array{ranges.front().begin, ranges.back().end}, "ends_known",
                              std::array{begin_is_known(r, b), end_is_known(r, b)}, "stable", stable, "points",
                              PartOf{b.points, r.study}));
    for (const BranchEvent& e : b.events) events.push_back(e);
  }
  Json json = object("parameter", r.key, "values", r.values, "branches", branches, "events", events, "starts", r.starts,
                     "partial", r.partial);
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
  text += r.key + ",id,name,alias,kind,stable" + csv_names(motion_numbers);
  for (int i = 1; i <= balls; ++i) text += fmt::format(",drift_{}", i);
  if (r.study.speed.driven()) text += csv_names(motor_numbers);
  text += "\n";
  for (std::size_t k = 0; k < r.values.size(); ++k) {
    for (const Branch& b : r.branches) {
      const auto at = std::find_if(b.points.begin(), b.points.end(), [&](const BranchPoint& p) { return p.at == k; });
      if (at == b.points.end()) continue;
      const Motion& m = at->motion;
      text += fmt::format("{},{},{},{},{},{:d}", at->value, b.id, csv_text(b.name), csv_text(b.alias), name_of(m.kind),
                          m.stable);
      text += csv_numbers(motion_numbers, m);
      for (int i = 0; i < balls; ++i) text += fmt::format(",{}", m.drift[i] + 0.0);
      if (m.motor) text += csv_numbers(motor_numbers, m);
      text += "\n";
    }
  }
  return text;
}

}  // namespace equipoise
