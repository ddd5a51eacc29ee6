// Sentences, two tables and notes; numbers of curves, points and boxes.
#include "equipoise/extras/charts/chart_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "equipoise/core/base/plain_number.hpp"
#include "equipoise/core/base/plural.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/extras/charts/chart_regions_text.hpp"
#include "equipoise/extras/charts/shown_axis.hpp"
#include "equipoise/extras/charts/stability_report.hpp"
#include "equipoise/extras/words/chart.hpp"
#include "equipoise/report/text/computed.hpp"
#include "equipoise/report/text/csv.hpp"
#include "equipoise/report/text/motion_words.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/words/reports.hpp"

namespace equipoise {

namespace {

BalanceLoss loss_on(const BifurcationChart& chart, const ChartCurve& curve) {
  BalanceLoss loss;
  if (curve.of != of_balance || is_of_cycles(curve.kind)) return loss;
  const double wide = chart.plane.x.high - chart.plane.x.low, high = chart.plane.y.high - chart.plane.y.low;
  for (std::size_t k = 1; k < curve.points.size(); ++k) {
    const CurvePoint &a = curve.points[k - 1], &b = curve.points[k];
    if (a.others != 0 || b.others != 0) continue;
    const double length = std::hypot((b.x - a.x) / wide, (b.y - a.y) / high);
    const double lyapunov = std::isnan(a.lyapunov) ? b.lyapunov : a.lyapunov;
    if (curve.kind == CurveKind::zero)
      loss.real += length;
    else if (curve.kind == CurveKind::hopf)
      (lyapunov < 0.0 ? loss.soft : lyapunov > 0.0 ? loss.abrupt : loss.unknown) += length;
  }
  return loss;
}

std::string whole_percent(double part) {
  const double percent = 100.0 * part;
  return percent < 1.0 ? "less than 1 %" : percent > 99.0 ? "more than 99 %" : fmt::format("{:.0f} %", percent);
}

// Rounded down: no more is proved than is said.
std::string proved_percent(double part) { return fmt::format("{:.2f} %", std::floor(1e4 * part) / 100.0); }

std::string loss_sentences(const BifurcationChart& chart) {
  const BalanceLoss loss = balance_loss(chart);
  std::vector<std::string> sentences;
  if (loss.soft > 0.0 && loss.abrupt > 0.0)
    sentences.push_back(fmt::format(words::chart::both_ways, whole_percent(loss.soft / loss.length()),
                                    whole_percent(loss.abrupt / loss.length())));
  else if (loss.soft > 0.0)
    sentences.push_back(words::chart::softly);
  else if (loss.abrupt > 0.0)
    sentences.push_back(words::chart::abruptly);
  else if (loss.unknown > 0.0)
    sentences.push_back(words::chart::way_unknown);
  if (loss.real > 0.0) sentences.push_back(words::chart::real_loss);
  if (sentences.empty()) sentences.push_back(words::chart::no_loss);
  const auto ends = [](const ChartCurve& c) { return c.kind == CurveKind::existence; };
  if (std::any_of(chart.curves.begin(), chart.curves.end(), ends))
    sentences.push_back(chart.study.parameters.tilts() ? words::chart::balance_ends_in_a_plane
                                                       : words::chart::balance_ends);
  return fmt::format("{}", fmt::join(sentences, " "));
}

std::string proof_sentence(const BifurcationChart& chart) {
  std::vector<std::string> parts;
  for (const auto& [kind, words] : {std::pair{ProvedKind::stable, words::chart::proved_stable},
                                    {ProvedKind::unstable, words::chart::proved_unstable},
                                    {ProvedKind::none, words::chart::proved_none}})
    if (const double part = chart.proved(kind); part > 0.0)
      parts.push_back(fmt::format(fmt::runtime(words), proved_percent(part)));
  if (parts.empty()) return words::chart::proved_nothing;
  const double open = chart.proved(ProvedKind::open);
  return fmt::format(words::chart::proved, fmt::join(parts, ", "),
                     fmt::format("{:.2f} %", std::ceil(1e4 * open) / 100.0));
}

// In the units of the axes.
std::string place_text(const BifurcationChart& chart, double x, double y) {
  return plain_number(x * shown_axis(chart.study, chart.plane.x).factor, 4) + ", " +
         plain_number(y * shown_axis(chart.study, chart.plane.y).factor, 4);
}

std::string axis_words(const BifurcationChart& chart, const SliceAxis& axis) {
  const std::string unit = shown_axis(chart.study, axis).unit;
  return unit.empty() ? axis.key : fmt::format(words::chart::axis_in_unit, axis.key, unit);
}

const char* curve_words(CurveKind kind) {
  constexpr std::array words{words::chart::is_hopf,       words::chart::is_zero,       words::chart::is_existence,
                             words::chart::is_fold,       words::chart::is_pitchfork,  words::chart::is_cycle_fold,
                             words::chart::is_cycle_flip, words::chart::is_cycle_torus};
  return words[static_cast<std::size_t>(kind)];
}

const char* loss_words(const BifurcationChart& chart, const ChartCurve& curve) {
  if (curve.kind == CurveKind::existence) return words::chart::how_ends;
  if (is_of_cycles(curve.kind)) {
    const auto stable = [](const CurvePoint& p) { return p.others == 0; };
    const auto count = static_cast<std::size_t>(std::count_if(curve.points.begin(), curve.points.end(), stable));
    if (count == 0) return words::chart::how_unstable_cycles;
    return count == curve.points.size() ? words::chart::how_stable_cycle : words::chart::how_both_cycles;
  }
  if (curve.of != of_balance) {
    const auto stable = [](const CurvePoint& p) { return p.others == 0; };
    const bool some = std::any_of(curve.points.begin(), curve.points.end(), stable);
    return some ? words::chart::how_stable_state : words::chart::how_unstable_states;
  }
  const BalanceLoss loss = loss_on(chart, curve);
  if (loss.real > 0.0) return words::chart::how_real;
  if (loss.soft > 0.0 && loss.abrupt > 0.0) return words::chart::how_both;
  return loss.soft > 0.0      ? words::chart::how_softly
         : loss.abrupt > 0.0  ? words::chart::how_abruptly
         : loss.unknown > 0.0 ? words::chart::how_unknown
                              : words::chart::how_before;
}

std::string frequency_text(const ChartCurve& curve) {
  if (curve.kind != CurveKind::hopf && !is_of_cycles(curve.kind)) return "";
  double low = INFINITY, high = -INFINITY;
  for (const CurvePoint& p : curve.points) low = std::min(low, p.frequency), high = std::max(high, p.frequency);
  const std::string least = fmt::format("{:.3g}", low), most = fmt::format("{:.3g}", high);
  return least == most ? least : fmt::format("{} to {}", least, most);
}

const char* special_words(SpecialKind kind) {
  namespace w = words::chart;
  constexpr std::array words{
      w::is_generalised_hopf, w::is_double_hopf, w::is_zero_hopf,     w::is_bogdanov_takens, w::is_cusp,
      w::is_fold_hopf,        w::is_cycle_cusp,  w::is_resonance_1_1, w::is_resonance_1_2,   w::is_resonance_1_3,
      w::is_resonance_1_4,    w::is_fold_flip,   w::is_fold_torus,    w::is_flip_torus,      w::is_double_torus,
      w::is_generalised_flip};
  static_assert(words.size() == special_kind_names.size());
  return words[static_cast<std::size_t>(kind)];
}

std::string curves_table(const BifurcationChart& chart, const TextStyle& style) {
  namespace w = words::chart;
  DocumentTable table{
      {w::curve, w::what_crosses, w::of, w::from_place, w::to_place, w::frequency, w::how}, {}, "", false, {5, 4}};
  for (std::size_t k = 0; k < chart.curves.size(); ++k) {
    const ChartCurve& c = chart.curves[k];
    const CurvePoint &a = c.points.front(), &b = c.points.back();
    table.rows.push_back(
        row_of("ntttttt", {fmt::format("{}", k + 1), curve_words(c.kind), c.of, place_text(chart, a.x, a.y),
                           place_text(chart, b.x, b.y), frequency_text(c), loss_words(chart, c)}));
  }
  return table_text(table, style);
}

std::string specials_table(const BifurcationChart& chart, const TextStyle& style) {
  namespace w = words::chart;
  DocumentTable table{{w::place, w::meaning, w::frequency, w::curve}, {}, "", false, {3, 2}};
  for (const SpecialPoint& p : chart.specials) {
    const std::string second = p.second > 0.0 ? fmt::format(", {:.3g}", p.second) : "";
    table.rows.push_back(
        row_of("tttn", {place_text(chart, p.x, p.y), special_words(p.kind),
                        fmt::format("{:.3g}{}", p.frequency, second), fmt::format("{}", p.curve + 1)}));
  }
  return table_text(table, style);
}

std::string cycles_end_text(const BifurcationChart& chart) {
  namespace w = words::chart;
  const std::pair<CurveEnd, std::string> reasons[] = {
      {CurveEnd::plane, w::end_plane},
      {CurveEnd::closed, w::end_closed},
      {CurveEnd::single_cycle, w::end_single_cycle},
      {CurveEnd::vanishes, w::end_vanishes},
      {CurveEnd::resonance, w::end_resonance},
      {CurveEnd::long_period, fmt::format(w::end_long_period, chart.cycle_bounds.turns)},
      {CurveEnd::multiplier, fmt::format(w::end_multiplier, chart.cycle_bounds.multiplier)},
      {CurveEnd::points, fmt::format(w::end_points, chart.cycle_bounds.points)},
      {CurveEnd::lost, w::end_lost},
      {CurveEnd::stopped, w::end_stopped}};
  std::vector<std::string> parts;
  for (const auto& [end, reason] : reasons) {
    std::vector<std::size_t> which;
    for (std::size_t k = 0; k < chart.curves.size(); ++k) {
      const ChartCurve& c = chart.curves[k];
      if (is_of_cycles(c.kind) && (c.ends[0] == end || c.ends[1] == end)) which.push_back(k + 1);
    }
    if (!which.empty()) parts.push_back(fmt::format(w::cycles_end_at, reason, fmt::join(which, ", ")));
  }
  return parts.empty() ? "" : fmt::format(w::cycles_end, fmt::join(parts, "; "));
}

// Of all that are not of cycles.
std::string lost_curves_text(const BifurcationChart& chart) {
  std::vector<std::size_t> which;
  for (std::size_t k = 0; k < chart.curves.size(); ++k) {
    const ChartCurve& c = chart.curves[k];
    if (!is_of_cycles(c.kind) && (c.ends[0] == CurveEnd::lost || c.ends[1] == CurveEnd::lost)) which.push_back(k + 1);
  }
  if (which.empty()) return "";
  return fmt::format(words::chart::curves_lost, fmt::join(which, ", ")) +
         (chart.plane.of_several() ? words::chart::lost_to_another_state : "");
}

std::string chart_notes(const BifurcationChart& chart) {
  std::string text;
  if (chart.curves.empty()) {
    text += words::chart::no_curve;
  } else {
    text += fmt::format(words::chart::places_are, axis_words(chart, chart.plane.x), axis_words(chart, chart.plane.y));
    double error = 0.0;
    for (const ChartCurve& c : chart.curves) error = std::max(error, c.error);
    text += fmt::format(words::chart::precise, std::max(error, 1e-16));
  }
  text += lost_curves_text(chart) + cycles_end_text(chart);
  if (chart.plane.contact()) text += words::chart::contact_bound;
  if (!chart.not_proved.empty()) text += fmt::format(words::chart::not_proved, chart.not_proved);
  if (chart.complete && !chart.boxes.empty() && chart.proved(ProvedKind::open) > chart.undecided)
    text += words::chart::boxes_used_up;
  if (!chart.no_cycles.empty()) text += fmt::format(words::chart::no_cycles, chart.no_cycles);
  text += region_notes(chart) + plane_notes(chart.plane);
  if (chart.cycles_left > 0)
    text += fmt::format(words::chart::partial_cycles, chart.cycles_left, plural(chart.cycles_left),
                        chart.cycles_left == 1 ? "was" : "were");
  else if (!chart.complete && chart.plane.complete)
    text += words::chart::partial;
  return text;
}

using ChartJson = nlohmann::ordered_json;

// What is not a number is written as null.
ChartJson curve_json(const ChartCurve& c) {
  ChartJson json{{"kind", curve_kind_names[static_cast<std::size_t>(c.kind)]}, {"of", c.of}};
  for (const CurveEnd end : c.ends) json["ends"].push_back(curve_end_names[static_cast<std::size_t>(end)]);
  json["error"] = c.error;
  for (const CurveNumber& n : curve_numbers) {
    if (n.of_cycles && !is_of_cycles(c.kind)) continue;
    ChartJson& numbers = json[n.name] = ChartJson::array();
    for (const CurvePoint& p : c.points)
      numbers.push_back(n.whole ? ChartJson(static_cast<int>(n.value(p))) : ChartJson(n.value(p)));
  }
  return json;
}

}  // namespace

BalanceLoss balance_loss(const BifurcationChart& chart) {
  BalanceLoss loss;
  for (const ChartCurve& curve : chart.curves) {
    const BalanceLoss part = loss_on(chart, curve);
    loss.soft += part.soft;
    loss.abrupt += part.abrupt;
    loss.unknown += part.unknown;
    loss.real += part.real;
  }
  return loss;
}

std::string chart_answer(const BifurcationChart& chart) {
  std::string text = stability_answer(chart.plane);
  // Curves of cycles come last: where some of them are left, what goes before is whole.
  if (!chart.complete && chart.cycles_left == 0) return text;
  text += " " + loss_sentences(chart);
  if (!chart.boxes.empty()) text += " " + proof_sentence(chart);
  return text;
}

std::string chart_text(const BifurcationChart& chart, const TextStyle& style) {
  std::string text = filled("answer   ", chart_answer(chart), style) + "\n";
  text += lines_filled(plane_heading(chart.plane), style) + "\n";
  if (!chart.curves.empty()) text += curves_table(chart, style) + "\n";
  if (!chart.specials.empty()) text += specials_table(chart, style) + "\n";
  if (!chart.regions.empty()) text += regions_list(chart, style) + "\n";
  return text + lines_filled(chart_notes(chart) + fmt::format(words::chart::made_with, chart.curves.size(),
                                                              plural(chart.curves.size()), chart.boxes.size(),
                                                              computed_text(chart), version_string),
                             style);
}

std::string chart_json(const BifurcationChart& chart) {
  ChartJson json;
  for (const auto& [letter, axis] : {std::pair{"x", &chart.plane.x}, {"y", &chart.plane.y}})
    json[letter] = {{"key", axis->key}, {"low", axis->low}, {"high", axis->high}, {"points", axis->pixels}};
  json["answer"] = chart_answer(chart);
  json["one_of_many"] = chart.plane.one_of_many();
  json["of_several"] = chart.plane.of_several();
  const auto* own = chart.plane.own ? &*chart.plane.own : nullptr;
  json["continuum"] = own && own->continuum ? ChartJson(continuum_json(*own->continuum)) : ChartJson(nullptr);
  json["curves"] = ChartJson::array();
  for (const ChartCurve& c : chart.curves) json["curves"].push_back(curve_json(c));
  json["specials"] = ChartJson::array();
  for (const SpecialPoint& p : chart.specials)
    json["specials"].push_back({{"kind", special_kind_names[static_cast<std::size_t>(p.kind)]},
                                {"curve", p.curve},
                                {"x", p.x},
                                {"y", p.y},
                                {"frequency", p.frequency},
                                {"second", p.second}});
  json["regions"] = ChartJson::array();
  for (const ChartRegion& r : chart.regions) {
    ChartJson region{
        {"states", region_words(chart, r)},
        {"balance", balance_kind_names[static_cast<std::size_t>(std::max(0, static_cast<int>(r.balance)))]},
        {"locked", ChartJson::object()},
        {"part", r.part},
        {"x", r.x},
        {"y", r.y}};
    for (std::size_t k = 0; k < r.locked.size(); ++k)
      region["locked"][chart.locked[k]] = {{"stable", r.locked[k].stable}, {"unstable", r.locked[k].unstable}};
    json["regions"].push_back(std::move(region));
  }
  json["region_of"] = chart.region_of;
  const BalanceLoss loss = balance_loss(chart);
  json["loss"] = {{"soft", loss.soft}, {"abrupt", loss.abrupt}, {"unknown", loss.unknown}, {"real", loss.real}};
  ChartJson proof{{"stable", chart.proved(ProvedKind::stable)},
                  {"unstable", chart.proved(ProvedKind::unstable)},
                  {"none", chart.proved(ProvedKind::none)},
                  {"open", chart.proved(ProvedKind::open)},
                  {"boxes", ChartJson::array()}};
  for (const ProofBox& b : chart.boxes)
    proof["boxes"].push_back({b.x[0], b.x[1], b.y[0], b.y[1], static_cast<int>(b.kind)});
  json["proof"] = chart.boxes.empty() ? ChartJson(nullptr) : proof;
  json["partial"] = !chart.complete;
  add_computed(json, chart);
  return json.dump() + "\n";
}

std::string chart_csv(const BifurcationChart& chart) {
  std::string text =
      chart.complete ? "" : fmt::format(words::chart::csv_partial, version_string, words::reports::csv_partial_early);
  text += fmt::format("curve,kind,of,{},{}", chart.plane.x.key, chart.plane.y.key);
  for (std::size_t n = 2; n < curve_numbers.size(); ++n) text += std::string(",") + curve_numbers[n].name;
  text += "\n";
  for (std::size_t k = 0; k < chart.curves.size(); ++k)
    for (const CurvePoint& p : chart.curves[k].points) {
      text += fmt::format("{},{},{}", k + 1, curve_kind_names[static_cast<std::size_t>(chart.curves[k].kind)],
                          chart.curves[k].of);
      for (const CurveNumber& n : curve_numbers) text += "," + csv_number(n.value(p));
      text += "\n";
    }
  return text;
}

}  // namespace equipoise
