// Sentences, two tables and notes; numbers of curves, points and boxes.
#include "equipoise/extras/charts/plane_reports.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/plane_frame.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/csv.hpp"
#include "equipoise/report/text/motion_words.hpp"

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
    sentences.push_back(fmt::format(
        "Balance loses its stability softly along {} of the line, where beyond it the balls swing about their places, "
        "little at first, and more with the distance from it. Along {} it does so abruptly: beyond the line no small "
        "swing is left, and the balls leave for another motion; shortly before it a push may be enough.",
        whole_percent(loss.soft / loss.length()), whole_percent(loss.abrupt / loss.length())));
  else if (loss.soft > 0.0)
    sentences.push_back(
        "Where balance loses its stability it does so softly: beyond the line the balls swing about their places, "
        "little at first, and more with the distance from it.");
  else if (loss.abrupt > 0.0)
    sentences.push_back(
        "Where balance loses its stability it does so abruptly: beyond the line no small swing is left, and the balls "
        "leave for another motion; shortly before it a push may be enough.");
  else if (loss.unknown > 0.0)
    sentences.push_back(
        "Where balance loses its stability the balls begin to swing; whether softly or abruptly is not known for "
        "balanced states that form a continuum, nor under a motor.");
  if (loss.real > 0.0) sentences.push_back("On another line balance loses its stability without a swing.");
  if (sentences.empty()) sentences.push_back("No line on which a stable balance loses its stability was found.");
  const auto ends = [](const ChartCurve& c) { return c.kind == CurveKind::existence; };
  if (std::any_of(chart.curves.begin(), chart.curves.end(), ends))
    sentences.push_back(chart.plane.study.parameters.tilts()
                            ? "On the line where balance ends, all balls of one plane are in line, and states merge."
                            : "On the line where balance ends, all balls are in line, and their states merge.");
  return fmt::format("{}", fmt::join(sentences, " "));
}

std::string proof_sentence(const BifurcationChart& chart) {
  std::vector<std::string> parts;
  for (const BalanceKind kind : {BalanceKind::stable, BalanceKind::unstable, BalanceKind::none})
    if (const double part = chart.proved(kind); part > 0.0)
      parts.push_back(fmt::format("{} all over {}", balance_words(kind), proved_percent(part)));
  if (parts.empty()) return "Interval arithmetic proved nothing.";
  const double open = chart.proved(BalanceKind::open);
  return fmt::format("Proved by interval arithmetic: {}; {} of the plane is not decided.", fmt::join(parts, ", "),
                     fmt::format("{:.2f} %", std::ceil(1e4 * open) / 100.0));
}

// In the units of the axes.
std::string place_text(const BifurcationChart& chart, double x, double y, int digits = 4) {
  return plain_number(x * axis_words(chart.plane.study, chart.plane.x).factor, digits) + ", " +
         plain_number(y * axis_words(chart.plane.study, chart.plane.y).factor, digits);
}

std::string key_and_unit(const BifurcationChart& chart, const SliceAxis& axis) {
  const std::string unit = axis_words(chart.plane.study, axis).unit;
  return unit.empty() ? axis.key : fmt::format("{} in {}", axis.key, unit);
}

const char* curve_words(CurveKind kind) {
  constexpr std::array words{"Hopf",      "real eigenvalue", "balance ends",    "fold",
                             "pitchfork", "fold of cycles",  "period doubling", "torus"};
  return words[static_cast<std::size_t>(kind)];
}

const char* loss_words(const BifurcationChart& chart, const ChartCurve& curve) {
  if (curve.kind == CurveKind::existence) return "it ends";
  if (is_of_cycles(curve.kind) || curve.of != of_balance) {
    const auto stable = [](const CurvePoint& p) { return p.others == 0; };
    const bool all = std::all_of(curve.points.begin(), curve.points.end(), stable),
               some = std::any_of(curve.points.begin(), curve.points.end(), stable);
    if (!is_of_cycles(curve.kind)) return some ? "a stable state" : "unstable states";
    return !some ? "unstable cycles" : all ? "a stable cycle" : "a cycle, stable on a part";
  }
  const BalanceLoss loss = loss_on(chart, curve);
  if (loss.real > 0.0) return "without a swing";
  if (loss.soft > 0.0 && loss.abrupt > 0.0) return "softly, abruptly";
  return loss.soft > 0.0      ? "softly"
         : loss.abrupt > 0.0  ? "abruptly"
         : loss.unknown > 0.0 ? "not known how"
                              : "nothing: unstable before";
}

std::string frequency_text(const ChartCurve& curve) {
  if (curve.kind != CurveKind::hopf && !is_of_cycles(curve.kind)) return "";
  double low = INFINITY, high = -INFINITY;
  for (const CurvePoint& p : curve.points) low = std::min(low, p.frequency), high = std::max(high, p.frequency);
  const std::string least = fmt::format("{:.3g}", low), most = fmt::format("{:.3g}", high);
  return least == most ? least : fmt::format("{} to {}", least, most);
}

const char* special_words(SpecialKind kind) {
  constexpr std::array words{"generalised Hopf: softly on one side, abruptly on the other",
                             "double Hopf: two swings begin at once",
                             "zero-Hopf: a swing begins where a real eigenvalue is 0",
                             "Bogdanov-Takens: the swing's frequency falls to 0",
                             "cusp: two folds meet",
                             "fold-Hopf: a swing begins where two states merge",
                             "cusp: two folds of cycles meet",
                             "1:1 resonance: a second multiplier is 1",
                             "1:2 resonance: a second multiplier is -1",
                             "1:3 resonance: the torus closes after three turns",
                             "1:4 resonance: the torus closes after four turns",
                             "fold-flip: cycles merge where their period doubles",
                             "fold-torus: cycles merge where a torus is born",
                             "flip-torus: a period doubles where a torus is born",
                             "double torus: two swings begin about a cycle",
                             "generalised doubling: softly on one side, abruptly on the other"};
  static_assert(words.size() == special_kind_names.size());
  return words[static_cast<std::size_t>(kind)];
}

DocumentTable curves_table(const BifurcationChart& chart) {
  DocumentTable table{{"curve", "what it is", "of", "from", "to", "frequency", "what is lost"}, {}, "", false, {5, 4}};
  for (std::size_t k = 0; k < chart.curves.size(); ++k) {
    const ChartCurve& c = chart.curves[k];
    const CurvePoint &a = c.points.front(), &b = c.points.back();
    table.rows.push_back(
        row_of("ntttttt", {fmt::format("{}", k + 1), curve_words(c.kind), c.of, place_text(chart, a.x, a.y),
                           place_text(chart, b.x, b.y), frequency_text(c), loss_words(chart, c)}));
  }
  return table;
}

DocumentTable specials_table(const BifurcationChart& chart) {
  DocumentTable table{{"at", "what it is", "frequency", "curve"}, {}, "", false, {3, 2}};
  for (const SpecialPoint& p : chart.specials) {
    const std::string second = p.second > 0.0 ? fmt::format(", {:.3g}", p.second) : "";
    table.rows.push_back(
        row_of("tttn", {place_text(chart, p.x, p.y), special_words(p.kind),
                        fmt::format("{:.3g}{}", p.frequency, second), fmt::format("{}", p.curve + 1)}));
  }
  return table;
}

// Numbers of the curves of cycles, or of all others, that end so.
std::vector<std::size_t> curves_that_end(const BifurcationChart& chart, bool of_cycles, CurveEnd end) {
  std::vector<std::size_t> which;
  for (std::size_t k = 0; k < chart.curves.size(); ++k) {
    const ChartCurve& c = chart.curves[k];
    if (is_of_cycles(c.kind) == of_cycles && (c.ends[0] == end || c.ends[1] == end)) which.push_back(k + 1);
  }
  return which;
}

std::string cycles_end_text(const BifurcationChart& chart) {
  const std::pair<CurveEnd, std::string> reasons[] = {
      {CurveEnd::plane, "at the plane's edge"},
      {CurveEnd::closed, "at their own beginning"},
      {CurveEnd::single_cycle, "where the cycle is a single one passed twice, on a curve of period doublings"},
      {CurveEnd::vanishes, "where the cycle shrinks to a state at rest"},
      {CurveEnd::resonance, "where a torus has a resonance 1:1 or 1:2"},
      {CurveEnd::long_period,
       fmt::format("where its period grows beyond {:g} turns and twice that at birth, near a homoclinic orbit",
                   chart.cycle_bounds.turns)},
      {CurveEnd::multiplier, fmt::format("where a multiplier grows beyond {:.0e}", chart.cycle_bounds.multiplier)},
      {CurveEnd::points, fmt::format("after {} points each way", chart.cycle_bounds.points)},
      {CurveEnd::lost, "where no next point was found"},
      {CurveEnd::stopped, "where the computation was stopped"}};
  std::vector<std::string> parts;
  for (const auto& [end, reason] : reasons)
    if (const auto which = curves_that_end(chart, true, end); !which.empty())
      parts.push_back(fmt::format("{} ({})", reason, fmt::join(which, ", ")));
  return parts.empty() ? "" : fmt::format("Curves of cycles end, by number: {}.\n", fmt::join(parts, "; "));
}

std::string lost_curves_text(const BifurcationChart& chart) {
  const auto which = curves_that_end(chart, false, CurveEnd::lost);
  if (which.empty()) return "";
  return fmt::format("Curves that end inside the plane because no next point was found, by number: {}.\n",
                     fmt::join(which, ", ")) +
         (chart.plane.of_several() ? "Where another balanced state becomes the most stable one a curve may end so.\n"
                                   : "");
}

// "balance stable; balls together unstable (2)".
std::string region_words(const BifurcationChart& chart, const ChartRegion& region) {
  std::string text = fmt::format("balance {}", balance_words(region.balance));
  for (std::size_t k = 0; k < region.locked.size(); ++k)
    for (const auto& [count, kind] :
         {std::pair{region.locked[k].stable, BalanceKind::stable}, {region.locked[k].unstable, BalanceKind::unstable}})
      if (count > 0)
        text += "; " + fmt::format("{} {}{}", chart.locked[k], balance_words(kind),
                                   count > 1 ? fmt::format(" ({})", count) : std::string());
  return text;
}

// A line per region: letter, part of the plane, what is at rest there.
Brief regions_list(const BifurcationChart& chart) {
  std::string lines;
  for (std::size_t k = 0; k < told_regions(chart); ++k) {
    const ChartRegion& r = chart.regions[k];
    lines += fmt::format("{} {:5.1f} %  {} (e.g. at {})\n", region_letter(k), 100.0 * r.part, region_words(chart, r),
                         place_text(chart, r.x, r.y, 3));
  }
  return {lines, "", std::string_view("A 100.0 %  ").size()};
}

// What the list leaves out, and what regions do not show.
std::string region_notes(const BifurcationChart& chart) {
  std::string text;
  if (!chart.no_locked.empty()) text += fmt::format("Other equilibria were not analysed: {}.\n", chart.no_locked);
  if (chart.regions.empty()) return text;
  if (const std::size_t more = chart.regions.size() - told_regions(chart); more > 0)
    text += fmt::format("Smaller regions are left out ({}); --json has them.\n", more);
  return text + "Regions list equilibria found on the grid, not periodic motions.\n";
}

std::string chart_notes(const BifurcationChart& chart) {
  std::string text;
  if (chart.curves.empty()) {
    text += "No curve was found.\n";
  } else {
    text += fmt::format("Places are {}, {}; frequencies are in omega_c.\n", key_and_unit(chart, chart.plane.x),
                        key_and_unit(chart, chart.plane.y));
    double error = 0.0;
    for (const ChartCurve& c : chart.curves) error = std::max(error, c.error);
    text += fmt::format("Points lie on their curves within {:.0e} of the plane's sides.\n", std::max(error, 1e-16));
  }
  text += lost_curves_text(chart) + cycles_end_text(chart);
  if (chart.plane.contact()) text += "Where balance ends because the balls lack room, no curve is drawn.\n";
  if (!chart.not_proved.empty()) text += fmt::format("Nothing is proved: {}.\n", chart.not_proved);
  if (chart.complete && !chart.boxes.empty() && chart.proved(BalanceKind::open) > chart.undecided)
    text += "More boxes (--boxes) would decide more of the plane.\n";
  if (!chart.no_cycles.empty()) text += fmt::format("Cycles were not analysed: {}.\n", chart.no_cycles);
  text += region_notes(chart) + plane_notes(chart.plane);
  if (chart.cycles_left > 0)
    text += fmt::format(
        "PARTIAL: stopped while curves of cycles were followed; at least {} place{} where cycles change {} left.\n",
        chart.cycles_left, plural(chart.cycles_left), chart.cycles_left == 1 ? "was" : "were");
  else if (!chart.complete && chart.plane.complete)
    text += "PARTIAL: stopped before all curves and boxes were done.\n";
  return text;
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

Document document_of(const BifurcationChart& chart) {
  Document document = document_with(chart.plane.study, chart_answer(chart), axes_text(chart.plane));
  document.add(chart_drawing(chart));
  document.add(curves_table(chart));
  document.add(specials_table(chart));
  document.add(regions_list(chart));
  document.add_lines(chart_notes(chart));
  document.add(
      Paragraph{fmt::format("{} curve{}, {} boxes; {}; equipoise {}", chart.curves.size(), plural(chart.curves.size()),
                            chart.boxes.size(), computed_text(chart.plane), version_string)});
  return document;
}

void to_json(Json& json, const ChartCurve& c) {
  json = object("kind", curve_kind_names[static_cast<std::size_t>(c.kind)], "of", c.of);
  for (const CurveEnd end : c.ends) json["ends"].push_back(curve_end_names[static_cast<std::size_t>(end)]);
  put(json, "error", c.error);
  for (const CurveNumber& n : curve_numbers)
    if (!n.of_cycles || is_of_cycles(c.kind))
      json[n.name] = list_of(c.points, [&](const CurvePoint& p) {
        return n.whole ? Json(static_cast<int>(n.value(p))) : Json(n.value(p));
      });
}

void to_json(Json& json, const SpecialPoint& p) {
  json = object("kind", special_kind_names[static_cast<std::size_t>(p.kind)], "curve", p.curve, "x", p.x, "y", p.y,
                "frequency", p.frequency, "second", p.second);
}

void to_json(Json& json, const ChartRegion::Locked& l) { json = object("stable", l.stable, "unstable", l.unstable); }

void to_json(Json& json, const PartOf<ChartRegion, BifurcationChart>& of) {
  const auto& [r, chart] = of;
  Json locked = Json::object();
  for (std::size_t k = 0; k < r.locked.size(); ++k) locked[chart.locked[k]] = r.locked[k];
  json = object("states", region_words(chart, r), "balance",
                balance_kind_names[static_cast<std::size_t>(std::max(0, static_cast<int>(r.balance)))], "locked",
                locked, "part", r.part, "x", r.x, "y", r.y);
}

void to_json(Json& json, const ProofBox& b) { json = {b.x[0], b.x[1], b.y[0], b.y[1], static_cast<int>(b.kind)}; }

void to_json(Json& json, const BalanceLoss& loss) {
  json = object("soft", loss.soft, "abrupt", loss.abrupt, "unknown", loss.unknown, "real", loss.real);
}

std::string json_text(const BifurcationChart& chart) {
  const auto axis = [](const SliceAxis& a) {
    return object("key", a.key, "low", a.low, "high", a.high, "points", a.pixels);
  };
  Json json = object("x", axis(chart.plane.x), "y", axis(chart.plane.y), "answer", chart_answer(chart), "one_of_many",
                     chart.plane.one_of_many(), "of_several", chart.plane.of_several(), "continuum",
                     chart.plane.own ? Json(chart.plane.own->continuum) : Json(), "curves", chart.curves, "specials",
                     chart.specials, "regions", PartOf{chart.regions, chart}, "region_of", chart.region_of, "loss",
                     balance_loss(chart), "proof", nullptr);
  if (!chart.boxes.empty())
    json["proof"] =
        object("stable", chart.proved(BalanceKind::stable), "unstable", chart.proved(BalanceKind::unstable), "none",
               chart.proved(BalanceKind::none), "open", chart.proved(BalanceKind::open), "boxes", chart.boxes);
  put(json, "partial", !chart.complete);
  add_computed(json, chart.plane);
  return json.dump() + "\n";
}

std::string chart_csv(const BifurcationChart& chart) {
  std::string text =
      chart.complete ? "" : fmt::format("# equipoise {}: chart, PARTIAL: stopped early\n", version_string);
  const PlaneColumns axes(chart.plane.study, chart.plane.x, chart.plane.y);
  text += "curve,kind,of," + axes.titles;
  for (std::size_t n = 2; n < curve_numbers.size(); ++n)
    text += "," + csv_title(curve_numbers[n], chart.plane.study.scales);
  text += "\n";
  for (std::size_t k = 0; k < chart.curves.size(); ++k)
    for (const CurvePoint& p : chart.curves[k].points) {
      text += fmt::format("{},{},{},{}", k + 1, curve_kind_names[static_cast<std::size_t>(chart.curves[k].kind)],
                          chart.curves[k].of, axes.values(p.x, p.y));
      text += csv_numbers(std::span(curve_numbers).subspan(2), p) + "\n";  // without the place
    }
  return text;
}

}  // namespace equipoise
