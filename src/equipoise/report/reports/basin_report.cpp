// The result of an ensemble as JSON, and how it was sampled, as JSON and in words.
#include "equipoise/report/reports/reports.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/core/base/version.hpp"
#include "equipoise/report/decision/standards_text.hpp"
#include "equipoise/report/reports/basin_parts.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/study/sampling/scrambled_sobol.hpp"

namespace equipoise {

namespace {

SamplingMethod method_of(const BasinResult& r) { return r.study.sampling.method.value_or(SamplingMethod::random); }

// Digits in groups of three, for numbers of five digits or more.
std::string grouped(double value) {
  std::string text = fmt::format("{:.0f}", value);
  if (text.size() < 5) return text;
  for (int at = static_cast<int>(text.size()) - 3; at > 0; at -= 3) text.insert(static_cast<std::size_t>(at), 1, ' ');
  return text;
}

// Rounded to `digits` significant digits.
std::string rounded(double value, int digits) {
  if (!(value >= 1.0)) return grouped(value);
  const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(value)) + 1.0 - digits));
  return grouped(std::round(value / unit) * unit);
}

std::string points_text(const BasinResult& r) {
  const std::uint64_t points = r.starts / sobol_replicates, rest = r.starts % sobol_replicates;
  return fmt::format("{} x {}{}", sobol_replicates, grouped(static_cast<double>(points)),
                     rest == 0 ? "" : fmt::format(" + {}", rest));
}

std::string choice_text(const BasinResult& r) {
  const SamplingChoice& c = *r.choice;
  if (c.pilot == 0)
    return fmt::format(
        "Sampling: random starts, in blocks; this half-width needs at most {}, too few for a pilot of Sobol starts.\n",
        rounded(c.random_starts, 3));
  if (c.method == SamplingMethod::random)
    return fmt::format("Sampling: random, about {} starts needed; Sobol starts would need {}, says a pilot of {}.\n",
                       rounded(c.random_starts, 3), rounded(c.sobol_starts, 3), grouped(static_cast<double>(c.pilot)));
  return fmt::format("Sampling: scrambled Sobol, {} starts; random starts would have needed about {}.\n",
                     points_text(r), rounded(c.random_starts, 3));
}

std::string grid_text(const BasinResult& r) {
  const JitteredGrid& g = *r.grid;
  std::string text =
      fmt::format("Sampling: jittered grid, {}{} cells, two starts per cell", grouped(static_cast<double>(g.side())),
                  r.study.parameters.balls == 1 ? "" : fmt::format("^{}", r.study.parameters.balls));
  text += ".\n";
  if (g.exchange() && r.study.parameters.balls > 1)
    text += fmt::format("The balls are alike: {} cells stand for all {}, so shares are weighted, counts are not.\n",
                        grouped(static_cast<double>(g.cells())), grouped(g.all_cells()));
  return text;
}

bool falls_back(const BasinResult& r) {
  const auto wilson = [](const OutcomeShare& o) { return o.share.by == IntervalBy::wilson; };
  const std::vector<OutcomeShare> others = r.others();
  return std::any_of(r.attractors.begin(), r.attractors.end(), wilson) ||
         std::any_of(others.begin(), others.end(), [&](const auto& o) { return o.id != stalled_code && wilson(o); });
}

std::string in_si(const OutcomeNumber& n) { return std::string(n.name) + "_si"; }

}  // namespace

std::string as_good_as(const Share& share) {
  return share.by == IntervalBy::wilson ? "-" : rounded(share.effective_starts, 2);
}

std::string sampling_text(const BasinResult& r) {
  std::string text;
  if (r.own_starts) return "Starts: given, not drawn; intervals are those of random starts.\n";
  if (method_of(r) == SamplingMethod::grid)
    text = grid_text(r);
  else if (r.choice)
    text = choice_text(r);
  else if (method_of(r) == SamplingMethod::sobol)
    text = fmt::format("Sampling: scrambled Sobol, {} starts.\n", points_text(r));
  if (method_of(r) == SamplingMethod::random) return text;
  text += method_of(r) == SamplingMethod::sobol
              ? fmt::format("Intervals: Student's t over the {} independent replicates", sobol_replicates)
              : std::string("Intervals: from the differences between the two starts of each cell");
  if (falls_back(r)) text += "; Wilson's where the last column has a dash";
  return text + ".\nAs good as: random starts that give the same standard error.\n";
}

void to_json(Json& json, const PartOf<Sampling, BasinResult>& of) {
  const BasinResult& r = of.whole;
  json = object("method", "given");
  if (r.own_starts) return;
  json = object("method", sampling_method_names[static_cast<std::size_t>(method_of(r))]);
  if (const auto drawn = drawn_instead(r.study); !drawn.empty()) put(json, "drawn_instead_of", drawn);
  if (method_of(r) == SamplingMethod::sobol)
    put(json, "replicates", sobol_replicates, "points_per_replicate", r.starts / sobol_replicates);
  if (r.grid)
    put(json, "cells_a_turn", r.grid->side(), "cells", r.grid->all_cells(), "cells_evaluated", r.grid->cells(),
        "starts_a_cell", 2, "exchange", r.grid->exchange());
  if (r.half_width > 0.0) put(json, "half_width", r.half_width);
  if (!r.choice) return;
  put(json, "chosen", true, "pilot_starts", r.choice->pilot, "random_starts_needed",
      std::round(r.choice->random_starts));
  if (r.choice->pilot > 0) put(json, "sobol_starts_needed", std::round(r.choice->sobol_starts));
  const std::string why = choice_text(r);
  put(json, "why", why.substr(10, why.size() - 11));  // without "Sampling: " and the end of the line
}

// Times as in the note; null if a lifetime may be infinite.
void to_json(Json& json, const PartOf<EscapeRate, Study>& of) {
  const auto& [c, study] = of;
  const double time = study.scales ? study.scales->time() : 1.0;
  json = object("undecided_after", c.watched_from * time, "starts", c.trajectories, "decided_later", c.escapes, "rate",
                QuantileEstimate{c.rate / time, c.low / time, c.high / time}, "median_lifetime",
                times({c.median, c.least, c.most}, time), "unit", study.scales ? "s" : "1/omega_c");
}

void to_json(Json& json, const InputSensitivity& input) {
  json = object("key", input.key, "first", input.indices.first, "total", input.indices.total);
}

void to_json(Json& json, const SensitivityResult& r) {
  json = object("rows", r.rows, "evaluations", r.evaluations, "undecided", r.undecided, "partial", r.partial,
                "balanced", r.balanced);
}

std::string json_text(const BasinResult& r, std::span<const TriedChange> tried) {
  Json json = object("starts", r.starts, "starts_asked", r.asked > 0 ? Json(r.asked) : Json(), "partial", r.partial,
                     "sampling", PartOf{r.study.sampling, r});
  const auto share = [&](const Share& s) {
    Json one = sure(s);
    if (method_of(r) != SamplingMethod::random)
      put(one, "interval", interval_names[static_cast<std::size_t>(s.by)], "standard_error", s.standard_error,
          "effective_random_starts", std::round(s.effective_starts));
    return one;
  };
  json["outcomes"] = list_of(r.attractors, [&](const OutcomeShare& a) {
    Json one = outcome_with(a, share(a.share));
    for (const OutcomeNumber& n : outcome_numbers) {
      put(one, n.name, n.value(a));
      if (r.study.scales && n.dimension)
        put(one, in_si(n).c_str(), n.value(a) * study::scale_of(*n.dimension, *r.study.scales));
    }
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
  put(json, "confidence", 0.95, "units", Json::object());
  Json& units = json["units"];
  for (const OutcomeNumber& n : outcome_numbers) {
    put(units, n.name, n.unit());
    if (r.study.scales && n.dimension) put(units, in_si(n).c_str(), study::words(*n.dimension).si);
  }
  if (r.stalled) put(units, "below", "omega_c");
  if (r.passed) put(units, "above", "omega_c");
  if (r.met) put(json, "balls_met", share(*r.met));
  if (r.chaos) put(json, "long_lived_chaos", PartOf{*r.chaos, r.study});
  if (const auto verdict = verdict_of(r, tried)) put(json, "verdict", PartOf{*verdict, tried});
  put_known(json, "standards", judged_by_standards(r));
  if (r.transients) put(json, "transients", PartOf{*r.transients, r.study});
  if (r.without_balls) put(json, "without_balls", PartOf{*r.without_balls, r.study});
  if (r.sensitivity) put(json, "sensitivity", r.sensitivity->inputs, "sensitivity_design", *r.sensitivity);
  put(json, "balanced_stable", r.balanced_stable, "note", r.note, "starts_per_second",
      r.seconds > 0.0 ? static_cast<double>(r.starts - r.resumed_from) / r.seconds : 0.0, "resumed_from",
      r.resumed_from, "law", name_of(r.study.speed.law));
  add_computed(json, r);
  return json.dump(2) + "\n";
}

}  // namespace equipoise
