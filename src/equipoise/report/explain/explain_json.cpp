// A study explained, as JSON.
#include <vector>

#include <nlohmann/json.hpp>

#include "equipoise/core/base/version.hpp"
#include "equipoise/report/explain/explain_report.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/results/commands/left_grade.hpp"

namespace equipoise {

namespace {

using Json = nlohmann::ordered_json;
using model::Scales;
using study::Dimension;

// A value with its SI value and unit, if there are scales.
Json value_json(double value, Dimension d, const std::optional<Scales>& scales) {
  Json json{{"dimensionless", value}};
  if (scales) {
    json["si"] = value * study::scale_of(d, *scales);
    json["unit"] = study::words(d).si;
  }
  return json;
}

Json pair_json(const std::array<double, 2>& values, Dimension d, const std::optional<Scales>& scales) {
  return Json::array({value_json(values[0], d, scales), value_json(values[1], d, scales)});
}

Json quantity_json(const ExplainedQuantity& q, const std::optional<Scales>& scales) {
  Json row{{"symbol", q.symbol}, {"name", q.name}};
  row.update(q.dimension ? value_json(q.value, *q.dimension, scales) : Json{{"dimensionless", q.value}});
  return row;
}

Json motion_json(const BalancedMotion& m, const Explanation& e) {
  Json json{{"stable", m.stable},
            {"angles", std::vector<double>(m.angles.begin(), m.angles.begin() + e.study.parameters.balls)}};
  json["time_constant"] = m.stable ? value_json(-1.0 / m.slowest_rate, Dimension::time, e.study.scales) : Json(nullptr);
  json["drag_sensitivity"] = m.drag_sensitivity;
  json["left_out"] = m.less;
  json["strobe"] =
      m.section_period > 0.0 ? value_json(m.section_period, Dimension::time, e.study.scales) : Json(nullptr);
  json["displacement_left"] = m.left ? value_json(*m.left, Dimension::length, e.study.scales) : Json(nullptr);
  if (m.slowest_if_sliding) json["slowest_rate_if_sliding"] = *m.slowest_if_sliding;
  json["eigenvalues"] = Json::array();
  for (const auto& v : m.eigenvalues) json["eigenvalues"].push_back({v.real(), v.imag()});
  return json;
}

Json list_json(const std::vector<double>& values, Dimension d, const std::optional<Scales>& scales) {
  Json list = Json::array();
  for (const double v : values) list.push_back(value_json(v, d, scales));
  return list;
}

Json whirl_json(const model::WhirlSpeeds& w, const std::optional<Scales>& scales) {
  Json json;
  if (w.of_both.empty())
    json = {{"forward", list_json(w.forward, Dimension::speed, scales)},
            {"backward", list_json(w.backward, Dimension::speed, scales)}};
  else
    json["of_both"] = list_json(w.of_both, Dimension::speed, scales);
  return json;
}

Json tilt_json(const TiltExplanation& t, const std::optional<Scales>& scales) {
  Json json{{"whirl", whirl_json(t.alone, scales)}, {"whirl_with_balls", whirl_json(t.with_balls, scales)}};
  json["couple_unbalance"] = value_json(t.couple, Dimension::inertia, scales);
  json["planes"] = Json::array();
  for (const ExplainedPlane& plane : t.planes)
    json["planes"].push_back({{"at", value_json(plane.at, Dimension::length, scales)},
                              {"unbalance", value_json(plane.unbalance, Dimension::unbalance, scales)},
                              {"least_unbalance", value_json(plane.least, Dimension::unbalance, scales)},
                              {"largest_unbalance", value_json(plane.most, Dimension::unbalance, scales)},
                              {"reason", plane.why_not}});
  json["displacement_at_bearings"] = list_json(t.at_bearings, Dimension::length, scales);
  json["force_at_bearings"] = list_json(t.forces, Dimension::force, scales);
  return json;
}

Json run_up_json(const RunUp& r, const std::optional<Scales>& scales) {
  const auto time = [&](const std::optional<double>& t) {
    return t ? value_json(*t, Dimension::time, scales) : Json(nullptr);
  };
  Json json{{"speed", value_json(r.speed, Dimension::speed, scales)}};
  json["inertia"] = value_json(r.inertia, Dimension::inertia, scales);
  json["without_losses"] = time(r.alone);
  json["with_own_unbalance"] = time(r.shaken);
  json["stalls_at"] = r.shaken ? Json(nullptr) : value_json(r.stalls_at, Dimension::speed, scales);
  return json;
}

Json advice_json(const Explanation& e) {
  Json rules = Json::array();
  for (const RuleOfThumb& r : e.advice) {
    Json rule{{"id", r.id}, {"name", r.name}, {"kept", r.kept ? Json(*r.kept) : Json(nullptr)}, {"words", r.words}};
    rule["figures"] = Json::array();
    for (const ExplainedQuantity& figure : r.figures) rule["figures"].push_back(quantity_json(figure, e.study.scales));
    rule["formula"] = r.formula;
    rule["source"] = r.source;
    rules.push_back(rule);
  }
  return rules;
}

}  // namespace

std::string explain_json(const Explanation& e) {
  const auto& scales = e.study.scales;
  Json json;
  json["quantities"] = Json::array();
  for (const auto& q : e.quantities) json["quantities"].push_back(quantity_json(q, scales));
  json["critical_speed"] = pair_json(e.critical_alone, Dimension::speed, scales);
  json["critical_speed_with_balls"] = pair_json(e.critical_with_balls, Dimension::speed, scales);
  json["final_speed"] = e.speed ? value_json(*e.speed, Dimension::speed, scales) : Json(nullptr);
  json["final_speed_reason"] = e.speed_words;
  json["run_up"] = e.run_up ? run_up_json(*e.run_up, scales) : Json(nullptr);
  json["cost"] = nullptr;
  if (e.cost)
    json["cost"] = {
        {"cpu_seconds", e.cost->total()}, {"search", e.cost->search}, {"search_ended", e.cost->search_ended},
        {"a_start", e.cost->a_start},     {"starts", e.cost->starts}, {"measured", e.cost->measured}};
  json["can_balance"] = e.balanced.kind != model::BalancedStates::Kind::none;
  json["reason"] = e.balanced.reason;
  json["static_sag"] = value_json(e.sag, Dimension::length, scales);
  json["weight"] = value_json(e.weight(), Dimension::force, scales);
  json["gravity_ratio"] = e.gravity_ratio ? Json(*e.gravity_ratio) : Json(nullptr);
  json["carried_round"] = nullptr;
  if (e.carrying)
    json["carried_round"] = {{"first_from", value_json(e.carrying->first, Dimension::speed, scales)},
                             {"all_from", value_json(e.carrying->all, Dimension::speed, scales)},
                             {"may_hang", e.carrying->may_hang()}};
  json["own_unbalance"] = value_json(e.study.parameters.eccentricity, Dimension::unbalance, scales);
  json["unbalance"] = value_json(e.unbalance, Dimension::unbalance, scales);
  json["least_unbalance"] = value_json(e.least_unbalance, Dimension::unbalance, scales);
  json["largest_unbalance"] = value_json(e.largest_unbalance, Dimension::unbalance, scales);
  json["balanced"] = e.motion ? motion_json(*e.motion, e) : Json(nullptr);
  json["not_linearised"] = e.no_motion;
  json["without_balls"] = nullptr;
  if (e.bare)
    json["without_balls"] = {{"displacement", pair_json(e.bare->displacement, Dimension::length, scales)},
                             {"force", pair_json(e.bare->force, Dimension::force, scales)}};
  json["balance_grade"] = nullptr;
  if (e.speed)
    if (const auto grade = own_balance_grade(e.study, *e.speed)) json["balance_grade"] = grade_json(*grade);
  if (e.tilt) json["tilt"] = tilt_json(*e.tilt, scales);
  json["reynolds_number"] = e.reynolds ? Json(*e.reynolds) : Json(nullptr);
  json["advice"] = advice_json(e);
  json["warnings"] = e.warnings;
  json["study"] = study_json(e.study);
  json["study_name"] = e.study.name;
  json["version"] = version_string;
  return json.dump(2) + "\n";
}

}  // namespace equipoise
