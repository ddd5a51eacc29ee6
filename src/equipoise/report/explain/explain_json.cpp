// A study explained, as JSON.
#include <vector>

#include "equipoise/core/base/version.hpp"
#include "equipoise/report/explain/explain_report.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/results/commands/left_grade.hpp"

namespace equipoise {

namespace {

using study::Dimension;

// Each value with its SI value and unit, if there are scales.
struct InBothForms {
  const std::optional<model::Scales>& scales;

  Json operator()(double value, Dimension d) const {
    Json json = object("dimensionless", value);
    if (scales) put(json, "si", value * study::scale_of(d, *scales), "unit", study::words(d).si);
    return json;
  }
  Json operator()(const std::optional<double>& value, Dimension d) const { return value ? (*this)(*value, d) : Json(); }
  template <class List>
  requires requires(const List& l) { l.size(); }
  Json operator()(const List& values, Dimension d) const {
    return list_of(values, [&](double value) { return (*this)(value, d); });
  }
  Json operator()(const ExplainedQuantity& q) const {
    Json row = object("symbol", q.symbol, "name", q.name);
    row.update(q.dimension ? (*this)(q.value, *q.dimension) : object("dimensionless", q.value));
    return row;
  }
  Json operator()(const model::WhirlSpeeds& w) const {
    if (!w.of_both.empty()) return object("of_both", (*this)(w.of_both, Dimension::speed));
    return object("forward", (*this)(w.forward, Dimension::speed), "backward", (*this)(w.backward, Dimension::speed));
  }
};

Json balanced_json(const BalancedMotion& m, const InBothForms& both, int balls) {
  const auto time = [&](bool there, double value) { return there ? both(value, Dimension::time) : Json(); };
  Json json = object("stable", m.stable, "angles", leading(m.angles, balls), "time_constant",
                     time(m.stable, -1.0 / m.slowest_rate), "drag_sensitivity", m.drag_sensitivity, "left_out", m.less,
                     "strobe", time(m.section_period > 0.0, m.section_period), "displacement_left",
                     both(m.left, Dimension::length));
  put_known(json, "slowest_rate_if_sliding", m.slowest_if_sliding);
  put(json, "eigenvalues", list_of(m.eigenvalues, complex_pair));
  return json;
}

Json tilt_json(const TiltExplanation& t, const InBothForms& both) {
  const auto plane = [&](const ExplainedPlane& p) {
    return object("at", both(p.at, Dimension::length), "unbalance", both(p.unbalance, Dimension::unbalance),
                  "least_unbalance", both(p.least, Dimension::unbalance), "largest_unbalance",
                  both(p.most, Dimension::unbalance), "reason", p.why_not);
  };
  return object("whirl", both(t.alone), "whirl_with_balls", both(t.with_balls), "couple_unbalance",
                both(t.couple, Dimension::inertia), "planes", list_of(t.planes, plane), "displacement_at_bearings",
                both(t.at_bearings, Dimension::length), "force_at_bearings", both(t.forces, Dimension::force));
}

Json run_up_json(const RunUp& r, const InBothForms& both) {
  return object("speed", both(r.speed, Dimension::speed), "inertia", both(r.inertia, Dimension::inertia),
                "without_losses", both(r.alone, Dimension::time), "with_own_unbalance", both(r.shaken, Dimension::time),
                "stalls_at", r.shaken ? Json() : both(r.stalls_at, Dimension::speed));
}

}  // namespace

std::string explain_json(const Explanation& e) {
  const InBothForms both{e.study.scales};
  const auto unbalance = [&](double value) { return both(value, Dimension::unbalance); };
  const auto rule = [&](const RuleOfThumb& r) {
    return object("id", r.id, "name", r.name, "kept", r.kept, "words", r.words, "figures", list_of(r.figures, both),
                  "formula", r.formula, "source", r.source);
  };
  Json json =
      object("quantities", list_of(e.quantities, both), "critical_speed", both(e.critical_alone, Dimension::speed),
             "critical_speed_with_balls", both(e.critical_with_balls, Dimension::speed), "final_speed",
             both(e.speed, Dimension::speed), "final_speed_reason", e.speed_words, "run_up",
             e.run_up ? run_up_json(*e.run_up, both) : Json(), "cost", nullptr);
  if (e.cost)
    json["cost"] =
        object("cpu_seconds", e.cost->total(), "search", e.cost->search, "search_ended", e.cost->search_ended,
               "a_start", e.cost->a_start, "starts", e.cost->starts, "measured", e.cost->measured);
  put(json, "can_balance", e.balanced.kind != model::BalancedStates::Kind::none, "reason", e.balanced.reason,
      "static_sag", both(e.sag, Dimension::length), "weight", both(e.weight(), Dimension::force), "gravity_ratio",
      e.gravity_ratio, "carried_round", nullptr);
  if (e.carrying)
    json["carried_round"] = object("first_from", both(e.carrying->first, Dimension::speed), "all_from",
                                   both(e.carrying->all, Dimension::speed), "may_hang", e.carrying->may_hang());
  put(json, "own_unbalance", unbalance(e.study.parameters.eccentricity), "unbalance", unbalance(e.unbalance),
      "least_unbalance", unbalance(e.least_unbalance), "largest_unbalance", unbalance(e.largest_unbalance), "balanced",
      e.motion ? balanced_json(*e.motion, both, e.study.parameters.balls) : Json(), "not_linearised", e.no_motion,
      "without_balls", nullptr);
  if (e.bare)
    json["without_balls"] = object("displacement", both(e.bare->displacement, Dimension::length), "force",
                                   both(e.bare->force, Dimension::force));
  const auto grade = e.speed ? own_balance_grade(e.study, *e.speed) : std::nullopt;
  put(json, "balance_grade", grade ? grade_json(*grade) : Json());
  if (e.tilt) put(json, "tilt", tilt_json(*e.tilt, both));
  put(json, "reynolds_number", e.reynolds, "advice", list_of(e.advice, rule), "warnings", e.warnings, "study", e.study,
      "study_name", e.study.name, "version", version_string);
  return json.dump(2) + "\n";
}

}  // namespace equipoise
