// The result of an ensemble as JSON.
#include "equipoise/report/reports/reports.hpp"

#include <array>
#include <cmath>

#include "equipoise/core/base/version.hpp"
#include "equipoise/report/answers/sampling_text.hpp"
#include "equipoise/report/decision/standards_text.hpp"
#include "equipoise/report/reports/sensitivity_report.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

std::string in_si(const OutcomeNumber& n) { return std::string(n.name) + "_si"; }

}  // namespace

// Times as in the note; null if a lifetime may be infinite.
void to_json(Json& json, const PartOf<EscapeRate, Study>& of) {
  const auto& [c, study] = of;
  const double time = study.scales ? study.scales->time() : 1.0;
  json = object("undecided_after", c.watched_from * time, "starts", c.trajectories, "decided_later", c.escapes, "rate",
                QuantileEstimate{c.rate / time, c.low / time, c.high / time}, "median_lifetime",
                times({c.median, c.least, c.most}, time), "unit", study.scales ? "s" : "1/omega_c");
}

std::string json_text(const BasinResult& r, std::span<const TriedChange> tried) {
  Json json = object("starts", r.starts, "starts_asked", r.asked > 0 ? Json(r.asked) : Json(), "partial", r.partial,
                     "sampling", PartOf{r.study.sampling, r});
  const auto share = [&](const Share& s) {
    Json one = sure(s);
    if (r.study.sampling.method.value_or(SamplingMethod::random) != SamplingMethod::random)
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
