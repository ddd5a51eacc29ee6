// The result of an ensemble as text and as JSON.
#include "equipoise/report/reports/reports.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/percent_text.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/answers/sampling_text.hpp"
#include "equipoise/report/decision/plain_names.hpp"
#include "equipoise/report/decision/standards_text.hpp"
#include "equipoise/report/reports/sensitivity_report.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

constexpr char known_after[] = "known after";

// Times as in the note; null if a lifetime may be infinite.
Json chaos_json(const BasinResult& r) {
  const EscapeRate& c = *r.chaos;
  const double time = r.study.scales ? r.study.scales->time() : 1.0;
  return object("undecided_after", c.watched_from * time, "starts", c.trajectories, "decided_later", c.escapes, "rate",
                QuantileEstimate{c.rate / time, c.low / time, c.high / time}, "median_lifetime",
                QuantileEstimate{c.median * time, c.least * time, c.most * time}, "unit",
                r.study.scales ? "s" : "1/omega_c");
}

// The grounds on which starts were decided, as shares of all starts.
std::string decided_text(const BasinResult& r) {
  if (r.starts == 0) return "";
  std::array<std::uint64_t, decided_by_count> counts{};
  for (const OutcomeShare& a : r.attractors)
    for (int k = 0; k < decided_by_count; ++k) counts[k] += a.decided_by[k];
  std::string text;
  for (int k = 1; k < decided_by_count; ++k)
    if (counts[k] > 0)
      text += fmt::format("{}{} {:.2f} %", text.empty() ? "" : ", ", decided_by_names[k],
                          100.0 * static_cast<double>(counts[k]) / static_cast<double>(r.starts));
  return text.empty() ? "" : fmt::format("Decided by: {} of all starts.\n", text);
}

// Shares of starts that passed the resonance, that did not, and for which this is unknown.
std::string passage_text(const BasinResult& r) {
  const Share &passed = *r.passed, &held = *r.not_passed;
  const double above = r.study.passed_speed();
  const bool from_above = std::fabs(r.study.speed.initial) >= above;
  const auto part = [](const Share& s) { return fmt::format("{} ({})", percent(s.share, digits_for(s)), interval(s)); };
  std::string text = fmt::format("{}: {} of all starts ({}), turning faster than {} in their motion or when last seen",
                                 from_above ? "Above the resonance in the end" : "Came through the resonance",
                                 percent(passed.share, digits_for(passed)), interval(passed),
                                 engineering(r.study.scales, above, study::Dimension::speed));
  if (held.count > 0) text += fmt::format("; held below: {}", part(held));
  const std::uint64_t open = passed.total - passed.count - held.count - r.lost();
  if (open > 0)
    text += fmt::format("; not known yet: {}, undecided and slower when last seen",
                        percent_text(static_cast<double>(open) / static_cast<double>(passed.total)));
  if (open > 0 && (passed.least > 0.0 || passed.most < 1.0))
    text += "; through, whatever the others do: " + bounds_text(passed);
  return text + ".\n";
}

// Whether collisions of balls mattered.
std::string contact_text(const Share& met) {
  if (met.count == 0)
    return "Contact: in no start did balls touch before its fate was known, so contact decided none.\n";
  return fmt::format("Contact: balls touched in {} of all starts ({}) before the outcome was known.\n",
                     percent(met.share, digits_for(met)), interval(met));
}

std::string stopped_basin_text(const BasinResult& r) {
  return fmt::format("PARTIAL: stopped after {}{} starts; the shares and intervals above are of those.\n", r.starts,
                     r.asked > 0 ? fmt::format(" of {}", r.asked) : "");
}

std::string run_text(const BasinResult& r, std::span<const TriedChange> tried) {
  const std::string seed = r.own_starts ? "" : fmt::format(", seed {}", r.study.sampling.seed);
  if (r.study.parameters.balls == 0) return fmt::format("{}; equipoise {}\n", computed_text(r), version_string);
  double seconds = 0.0, cpu_seconds = 0.0;
  for (const TriedChange& t : tried) seconds += t.seconds, cpu_seconds += t.cpu_seconds;
  const std::string more =
      tried.empty() ? "" : fmt::format("; the changes judged: {:.2f} s, {:.2f} s CPU", seconds, cpu_seconds);
  return fmt::format("{} starts{}; {}, {:.0f} starts/s{}; equipoise {}\n", r.starts, seed, computed_text(r),
                     static_cast<double>(r.starts - r.resumed_from) / r.seconds, more, version_string);
}

// The rotor alone.
std::string bare_text(const BasinResult& r, const TextStyle& style) {
  if (!r.without_balls) return "PARTIAL: stopped before anything was known.\n";
  std::string text = filled("", bare_words(r), style) + "\n" + table_text(bare_table(r), style);
  for (const std::string& sentence : without_balls_words(r)) text += filled("", sentence, style);
  return text + "\n" + standards_text(r, style);
}

std::string end_name(const BasinResult& r, const OutcomeShare& o) {
  return o.id == stalled_code
             ? "stalled below " + engineering(r.study.scales, r.study.stall_speed(), study::Dimension::speed)
             : o.name;
}

// Without rows for what no start came to: none_words() names those.
DocumentTable outcome_table(const BasinResult& r) {
  const bool even = r.study.sampling.method.value_or(SamplingMethod::random) != SamplingMethod::random;
  const bool open = r.undecided.count > 0, physical = r.study.scales.has_value();
  const double second = physical ? r.study.scales->time() : 1.0;
  const TransientResult* t = r.transients ? &*r.transients : nullptr;
  const study::ShownUnit velocity = study::shown_unit(study::Dimension::velocity, r.study.scales);
  DocumentTable table{{physical ? "what the balls do" : "outcome", "share, 95 % interval"}};
  const auto column = [&](bool there, const std::string& title, bool spare) {
    if (!there) return;
    if (spare) table.spare.push_back(table.header.size());
    table.header.push_back(title);
  };
  column(open, "bounds", false);
  column(t, fmt::format("RMS at end, {}", velocity.name), false);
  column(true, physical ? "known after, s" : known_after, true);
  column(true, "starts", true);
  column(even, "as good as", true);
  const auto row = [&](const std::string& name, Tone tone, const OutcomeShare& o, bool timed) {
    std::vector<DocumentCell> cells{{name, tone, false, true}, number_cell(share_with_interval(o.share))};
    if (open) cells.push_back(number_cell(o.id == undecided_code ? "-" : bounds_text(o.share)));
    if (t) {
      std::string rms = "-";
      for (const TransientGroup& g : t->groups)
        if (g.id == o.id && g.starts > 0)
          rms = fmt::format("{:.3g}", g.figure(&TransientRow::rms_velocity).mean * velocity.size);
      cells.push_back(number_cell(rms));
    }
    cells.push_back(number_cell(timed ? fmt::format("{:.4g}", o.mean_time * second) : "-"));
    cells.push_back(number_cell(fmt::format("{}", o.share.count)));
    if (even) cells.push_back(number_cell(as_good_as(o.share)));
    table.rows.push_back(std::move(cells));
  };
  for (const OutcomeShare& a : r.attractors)
    if (a.share.count > 0 || a.id == balanced_id) row(reader_title(a, physical), Tone::plain, a, a.share.count > 0);
  for (const OutcomeShare& o : r.others())
    if (o.share.count > 0) row(end_name(r, o), Tone::open, o, false);
  return table;
}

// "No start was undecided, diverged or failed (each below 0.19 %)." "No start came to: co-drifting, chaotic; locked;
// and none diverged or failed (...)." What undecided starts may still come to has a bound of its own.
std::string none_words(const BasinResult& r) {
  const bool physical = r.study.scales.has_value(), open = r.undecided.count > 0;
  std::vector<std::string> motions, ends;
  const Share *of_motions = nullptr, *of_ends = nullptr;
  for (const OutcomeShare& a : r.attractors) {
    if (a.share.count > 0 || a.id == balanced_id) continue;
    motions.push_back(reader_title(a, physical));
    of_motions = &a.share;
  }
  for (const OutcomeShare& o : r.others()) {
    if (o.share.count > 0) continue;
    of_ends = r.of(o.id);
    ends.push_back(o.id == undecided_code ? "was undecided" : end_name(r, o));
  }
  if (!of_ends) return "";
  const auto each = [](std::size_t count) { return count > 1 ? "each " : ""; };
  // Names of motions may hold commas.
  std::string text = "No start ";
  if (!motions.empty()) text += fmt::format("{}{}", "came to: ", fmt::join(motions, "; "));
  if (!motions.empty() && open)
    text += fmt::format(" ({}at most {}, however the undecided starts end)", each(motions.size()),
                        percent(of_motions->most, digits_for(*of_motions)));
  if (!motions.empty()) text += "; and none ";
  for (std::size_t k = 0; k < ends.size(); ++k) text += (k == 0 ? "" : k + 1 < ends.size() ? ", " : " or ") + ends[k];
  return text + fmt::format("{} ({}{}).", open ? " while followed" : "",
                            each(open ? ends.size() : motions.size() + ends.size()), interval(*of_ends));
}

std::string outcome_text(const BasinResult& r, const TextStyle& style) {
  const std::string table = table_text(outcome_table(r), style);
  std::string text = table + "\n";
  if (const std::string none = none_words(r); !none.empty()) text += filled("", none, style);
  if (r.undecided.count > 0)
    text += filled(
        "",
        "Intervals hold only if the undecided starts end elsewhere; bounds are 95 % limits that hold however they end.",
        style);
  // A narrow table has no such column.
  if (table.substr(0, table.find('\n')).find(known_after) != std::string::npos)
    text += filled("",
                   fmt::format("Known after: mean time until the outcome is certain, from when the drive no longer "
                               "changes and the balls are free{}.",
                               r.study.scales ? "" : ", in 1/omega_c"),
                   style);
  return text + "\n";
}

}  // namespace

std::string basin_text(const BasinResult& r, const TextStyle& style, std::span<const TriedChange> tried) {
  std::string text;
  if (const auto verdict = verdict_of(r, tried)) text += verdict_text(*verdict, style);
  text += lines_filled(study_heading(r.study) + (r.own_starts ? "" : uncertain_text(r.study)), style);
  if (r.study.parameters.balls == 0) return text + bare_text(r, style) + lines_filled(run_text(r, tried), style);
  if (r.starts == 0)
    return text + lines_filled("PARTIAL: stopped before the first start was decided; there are no shares.\n" +
                                   run_text(r, tried),
                               style);
  text += outcome_text(r, style);
  for (const std::vector<Block>& group : balancer_blocks(r)) text += blocks_text(group, style);
  if (r.transients && style.details) text += transient_text(*r.transients, r.study);
  if (r.sensitivity) text += sensitivity_text(*r.sensitivity);
  std::string notes = sampling_text(r);
  if (style.details) notes += decided_text(r);
  notes += left_unbalance_text(r.attractors, r.study);
  if (r.passed) notes += passage_text(r);
  if (r.met) notes += contact_text(*r.met);
  if (const std::string hanging = hanging_text(r.study); !hanging.empty())
    notes += fmt::format("Warning: {}.\n", hanging);
  if (!r.note.empty()) notes += fmt::format("Note: {}.\n", note_text(r.study, r.note));
  if (r.partial) notes += stopped_basin_text(r);
  return text + lines_filled(notes + run_text(r, tried), style);
}

std::string basin_json(const BasinResult& r, std::span<const TriedChange> tried) {
  Json json = object("starts", r.starts, "starts_asked", r.asked > 0 ? Json(r.asked) : Json(), "partial", r.partial,
                     "sampling", sampling_json(r));
  const auto share = [&](const Share& s) {
    Json one = sure(s);
    if (r.study.sampling.method.value_or(SamplingMethod::random) != SamplingMethod::random)
      put(one, "interval", interval_names[static_cast<std::size_t>(s.by)], "standard_error", s.standard_error,
          "effective_random_starts", std::round(s.effective_starts));
    return one;
  };
  json["outcomes"] = list_of(r.attractors, [&](const OutcomeShare& a) {
    Json one = outcome_with(a, share(a.share));
    put(one, "mean_time", a.mean_time);
    if (r.study.scales) put(one, "mean_time_si", a.mean_time * r.study.scales->time());
    for (int k = 1; k < decided_by_count; ++k) one["decided_by"][decided_by_names[k]] = a.decided_by[k];
    put_left_unbalance(one, a, r.study);
    return one;
  });
  for (const OutcomeShare& o : r.others()) {
    json[o.name] = share(o.share);
    if (o.id != stalled_code) continue;
    json[o.name]["below"] = r.study.stall_speed();
    if (r.passed) {
      put(json, "passed", share(*r.passed), "not_passed", share(*r.not_passed));
      json["passed"]["above"] = r.study.passed_speed();
    }
  }
  put(json, "confidence", 0.95, "units", object("mean_time", "1/omega_c"));
  Json& units = json["units"];
  if (r.study.scales) put(units, "mean_time_si", "s");
  if (r.stalled) put(units, "below", "omega_c");
  if (r.passed) put(units, "above", "omega_c");
  if (r.met) put(json, "balls_met", share(*r.met));
  if (r.chaos) put(json, "long_lived_chaos", chaos_json(r));
  if (const auto verdict = verdict_of(r, tried)) put(json, "verdict", verdict_json(*verdict, tried));
  if (Json judged = standards_json(r); !judged.is_null()) put(json, "standards", std::move(judged));
  if (r.transients) put(json, "transients", transient_json(*r.transients, r.study));
  if (r.without_balls) put(json, "without_balls", without_balls_json(*r.without_balls, r.study));
  if (r.sensitivity) put(json, "sensitivity", r.sensitivity->inputs, "sensitivity_design", *r.sensitivity);
  put(json, "balanced_stable", r.balanced_stable, "note", r.note, "starts_per_second",
      r.seconds > 0.0 ? static_cast<double>(r.starts - r.resumed_from) / r.seconds : 0.0, "resumed_from",
      r.resumed_from, "law", name_of(r.study.speed.law));
  add_computed(json, r);
  return json.dump(2) + "\n";
}

}  // namespace equipoise
