// Comparisons as a document and as JSON.
#include "equipoise/report/reports/reports.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/core/base/version.hpp"
#include "equipoise/report/text/motion_words.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/results/commands/outcome_share.hpp"

namespace equipoise {

namespace {

constexpr char starts_within_all_limits[] = "starts within all limits";

std::string points(double difference) { return fmt::format("{:+.2f}", 100.0 * difference); }

std::string interval_text(const ShareDifference& d) { return fmt::format("{} to {}", points(d.low), points(d.high)); }

// Means of transients, and how much more the second has.
DocumentTable figures_table(const ComparisonResult& r) {
  DocumentTable table{{"mean of starts", "first", "second", "second - first", "open"}, {}, "", false, {4}};
  bool open = false;
  for (const ComparedFigure& f : r.figures) {
    const MeanDifference& m = f.mean;
    const double half = 0.5 * (m.high - m.low);
    open = open || f.first_open + f.second_open > 0;
    table.rows.push_back(
        row_of("lnnnn",
               {fmt::format("{}, {}", f.title, f.unit), fmt::format("{:.4g}", m.first), fmt::format("{:.4g}", m.second),
                fmt::format("{:+.3g} ± {}", m.difference, std::isfinite(half) ? fmt::format("{:.2g}", half) : "?"),
                fmt::format("{}, {}", f.first_open, f.second_open)}));
  }
  table.caption = fmt::format(
      "Means and 95 % intervals of {}.{}", r.common ? "differences start by start" : "independent samples",
      open ? " Open: starts of the first and of the second whose figure is without bound; the means are of the others."
           : "");
  if (!open)
    for (auto& row : table.rows) row.pop_back();
  if (!open) table.header.pop_back();
  if (!open) table.spare.clear();
  return table;
}

}  // namespace

std::string verdict(const ComparisonResult& r) {
  if (r.starts == 0) return "No start of both is done: there is nothing to compare (basin -o keeps what it has done).";
  if (!r.limits && !r.balanced) return "No start of either ends balanced.";
  const ShareDifference& d = r.limits ? r.limits->difference : r.shares[*r.balanced].difference;
  const double low = r.limits ? r.limits->surely_low : r.surely_low,
               high = r.limits ? r.limits->surely_high : r.surely_high;
  const char* does = !r.limits ? "balances" : r.limits->alike ? "keeps every limit" : "keeps its own limits";
  const char* starts = r.limits ? starts_within_all_limits : "balanced starts";
  const std::string by = fmt::format("by {} points ({})", points(d.difference), interval_text(d));
  if (low > 0.0) return fmt::format("The second {} more often, {}.", does, by);
  if (high < 0.0)
    return fmt::format("The second {} less often, by {:.2f} points ({:.2f} to {:.2f}).", does, -100.0 * d.difference,
                       -100.0 * d.high, -100.0 * d.low);
  if (d.low > 0.0 || d.high < 0.0)
    return fmt::format("Open: the difference in {} is {}, but undecided starts could undo it ({} to {}).", starts, by,
                       points(low), points(high));
  return fmt::format("No difference in {} is shown: {} points.", starts, interval_text(d));
}

Document document_of(const ComparisonResult& r) {
  Document document{"Comparison", {}};
  document.add(Paragraph{verdict(r)});
  std::string sides = fmt::format("first\n{}second\n{}", study_heading(r.first) + uncertain_text(r.first),
                                  study_heading(r.second) + uncertain_text(r.second));
  sides.erase(sides.find_last_not_of('\n') + 1);
  document.add(Brief{sides, ""});
  DocumentTable table{{"outcome", "first", "second", "difference", "95 % interval, points"}};
  const auto row = [&](const std::string& name, const auto& s) {
    table.rows.push_back(row_of("lnnnn", {name, percent(s.first.share, 2), percent(s.second.share, 2),
                                          points(s.difference.difference), interval_text(s.difference)}));
  };
  if (r.limits) row(starts_within_all_limits, *r.limits);
  for (const ComparedShare& s : r.shares)
    if (s.first.count > 0 || s.second.count > 0) row(reader_title(s, r.first.scales.has_value()), s);
  document.add(std::move(table));
  document.add(figures_table(r));
  if (r.changed && r.starts > 0) {
    document.add(Paragraph{fmt::format("{} of {} common starts end differently: {} ({})", r.changed->count, r.starts,
                                       percent(r.changed->share, digits_for(*r.changed)), interval(*r.changed))});
    for (const ChangedOutcome& c : r.changes)
      document.add(Paragraph{fmt::format("{:>10}  from {} to {}", c.starts, c.from, c.to)});
  } else if (!r.common) {
    document.add(Paragraph{fmt::format("Compared as independent samples: {}.", r.why_not_common)});
  }
  if (r.partial)
    document.add(Paragraph{"PARTIAL: stopped before all starts were done; what is said above is of those that were.",
                           Tone::bad});
  document.add(Paragraph{fmt::format("equipoise {}", version_string)});
  return document;
}

void to_json(Json& json, const ComparedShare& s) {
  json = object("name", s.name, "alias", s.alias);
  json.update(Json(s.difference));
  put(json, "first", s.first, "second", s.second);
}

void to_json(Json& json, const ComparedLimits& l) {
  json = l.difference;
  put(json, "surely_low", l.surely_low, "surely_high", l.surely_high, "first", l.first, "second", l.second, "alike",
      l.alike);
}

void to_json(Json& json, const ComparedFigure& f) {
  const MeanDifference& m = f.mean;
  json = object("name", f.name, "unit", f.unit, "first", m.first, "second", m.second, "difference", m.difference, "low",
                m.low, "high", m.high, "counts", std::array{m.first_count, m.second_count}, "open",
                std::array{f.first_open, f.second_open});
}

void to_json(Json& json, const ChangedOutcome& c) { json = object("from", c.from, "to", c.to, "starts", c.starts); }

std::string json_text(const ComparisonResult& r) {
  Json json = object("differences", r.shares, "figures", r.figures, "common", r.common, "starts", r.starts, "changed",
                     r.changed ? Json(r.changed->count) : Json(), "changed_share", r.changed, "changes", r.changes,
                     "balanced_surely", object("low", r.surely_low, "high", r.surely_high));
  put_known(json, "limits", r.limits);
  put(json, "verdict", verdict(r), "partial", r.partial, "first", r.first, "second", r.second, "version",
      version_string);
  return json.dump(2) + "\n";
}

}  // namespace equipoise
