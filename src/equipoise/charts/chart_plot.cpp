// The script: boxes, curves in pieces of one kind, points, the legend.
#include "equipoise/charts/chart_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "equipoise/charts/chart_regions_text.hpp"
#include "equipoise/charts/shown_axis.hpp"
#include "equipoise/charts/stability_report.hpp"
#include "equipoise/drawing/plot_parts.hpp"
#include "equipoise/words/chart.hpp"
#include "equipoise/words/plots.hpp"
#include "equipoise/words/stability.hpp"

namespace equipoise {

namespace {

// How a piece of a curve is drawn.
enum class Stroke {
  soft,
  abrupt,
  hopf,
  zero,
  existence,
  fold,
  pitchfork,
  locked_hopf,
  cycle_fold,
  cycle_flip,
  cycle_torus
};

struct StrokeStyle {
  Stroke stroke;
  const char* look;
  const char* words;
};
constexpr std::array<StrokeStyle, 11> strokes{{
    {Stroke::soft, "linecolor rgb '#000000' linewidth 4", words::chart::legend_soft},
    {Stroke::abrupt, "linecolor rgb '#C00000' linewidth 4 dashtype (10,6)", words::chart::legend_abrupt},
    {Stroke::hopf, "linecolor rgb '#000000' linewidth 1.5", words::chart::legend_hopf},
    {Stroke::zero, "linecolor rgb '#000000' linewidth 2 dashtype (3,4)", words::chart::legend_zero},
    {Stroke::existence, "linecolor rgb '#444444' linewidth 2.5 dashtype (12,4,3,4)", words::chart::legend_existence},
    {Stroke::fold, "linecolor rgb '#6A3D9A' linewidth 3", words::chart::legend_fold},
    {Stroke::pitchfork, "linecolor rgb '#6A3D9A' linewidth 3 dashtype (3,5)", words::chart::legend_pitchfork},
    {Stroke::locked_hopf, "linecolor rgb '#1B7837' linewidth 3 dashtype (9,4)", words::chart::legend_locked_hopf},
    {Stroke::cycle_fold, "linecolor rgb '#E66101' linewidth 3", words::chart::legend_cycle_fold},
    {Stroke::cycle_flip, "linecolor rgb '#E66101' linewidth 3 dashtype (3,4)", words::chart::legend_cycle_flip},
    {Stroke::cycle_torus, "linecolor rgb '#E66101' linewidth 3 dashtype (10,4)", words::chart::legend_cycle_torus},
}};

Stroke stroke_of(const ChartCurve& curve, const CurvePoint& p) {
  if (curve.kind == CurveKind::zero) return Stroke::zero;
  if (curve.kind == CurveKind::fold) return Stroke::fold;
  if (curve.kind == CurveKind::pitchfork) return Stroke::pitchfork;
  if (curve.kind == CurveKind::cycle_fold) return Stroke::cycle_fold;
  if (curve.kind == CurveKind::cycle_flip) return Stroke::cycle_flip;
  if (curve.kind == CurveKind::cycle_torus) return Stroke::cycle_torus;
  if (curve.of != of_balance) return Stroke::locked_hopf;
  if (curve.kind == CurveKind::existence) return Stroke::existence;
  if (p.others > 0 || std::isnan(p.lyapunov)) return Stroke::hopf;
  return p.lyapunov < 0.0 ? Stroke::soft : Stroke::abrupt;
}

struct BoxLook {
  ProvedKind kind;
  const char* colour;
  BalanceKind balance;
};
constexpr std::array<BoxLook, 3> box_looks{{{ProvedKind::stable, "#8CC3E6", BalanceKind::stable},
                                            {ProvedKind::unstable, "#F3CF8E", BalanceKind::unstable},
                                            {ProvedKind::none, "#C8C8C8", BalanceKind::none}}};

}  // namespace

std::string chart_plot_script(const BifurcationChart& chart, const std::string& title, const std::string& path) {
  const StabilityPlane& plane = chart.plane;
  const ShownAxis x = shown_axis(chart.study, plane.x), y = shown_axis(chart.study, plane.y);
  std::string script = canvas(path, 1600, 1000), items;
  const auto add = [&](const std::string& item) { items += (items.empty() ? "" : ", \\\n  ") + item; };
  for (const BoxLook& look : box_looks) {
    std::string data;
    for (const ProofBox& b : chart.boxes)
      if (b.kind == look.kind)
        data += fmt::format("{0:.8g} {2:.8g} {0:.8g} {1:.8g} {2:.8g} {3:.8g}\n", b.x[0] * x.factor, b.x[1] * x.factor,
                            b.y[0] * y.factor, b.y[1] * y.factor);
    if (data.empty()) continue;
    script += fmt::format("$box{} << EOD\n{}EOD\n", static_cast<int>(look.kind), data);
    const std::string words = fmt::format(words::chart::legend_proved, balance_words(look.balance));
    add(fmt::format("$box{} with boxxyerror fillcolor rgb '{}' fillstyle solid 1.0 noborder title {}",
                    static_cast<int>(look.kind), look.colour, quoted(words)));
  }
  if (chart.proved(ProvedKind::open) > 0.0)
    add(
        fmt::format("keyentry with filledcurves fillcolor rgb '#FFFFFF' fillstyle solid 1.0 border linecolor rgb "
                    "'#444444' title {}",
                    quoted(words::chart::legend_open)));
  for (const StrokeStyle& style : strokes) {
    std::string data;
    for (const ChartCurve& curve : chart.curves)
      for (std::size_t k = 1; k < curve.points.size(); ++k) {
        const CurvePoint &a = curve.points[k - 1], &b = curve.points[k];
        if (stroke_of(curve, std::isnan(a.lyapunov) ? b : a) != style.stroke) continue;
        data += fmt::format("{:.8g} {:.8g}\n{:.8g} {:.8g}\n", a.x * x.factor, a.y * y.factor, b.x * x.factor,
                            b.y * y.factor);
        const bool goes_on = k + 1 < curve.points.size() && stroke_of(curve, b) == style.stroke;
        if (!goes_on) data += "\n";
      }
    if (data.empty()) continue;
    script += fmt::format("$curve{} << EOD\n{}EOD\n", static_cast<int>(style.stroke), data);
    add(fmt::format("$curve{} with lines {} title {}", static_cast<int>(style.stroke), style.look,
                    quoted(style.words)));
  }
  if (!chart.specials.empty()) {
    script += "$special << EOD\n";
    for (const SpecialPoint& p : chart.specials)
      script += fmt::format("{:.8g} {:.8g}\n", p.x * x.factor, p.y * y.factor);
    script += "EOD\n";
    add("$special with points pointtype 7 pointsize 1.7 linecolor rgb '#FFFFFF' notitle");
    add(fmt::format("$special with points pointtype 6 pointsize 1.4 linewidth 3 linecolor rgb '#000000' title {}",
                    quoted(words::chart::legend_special)));
  }
  if (const std::size_t regions = told_regions(chart); regions > 1) {
    const std::string unseen = "keyentry with lines linecolor rgb '#FFFFFF' title ";
    add(unseen + quoted(words::chart::legend_regions));
    for (std::size_t k = 0; k < regions; ++k) {
      const ChartRegion& r = chart.regions[k];
      script += fmt::format("set label {} {} at {:.8g},{:.8g} center front font ',22' textcolor rgb '#1A1A1A'\n", k + 1,
                            quoted(region_letter(k)), r.x * x.factor, r.y * y.factor);
      add(unseen + quoted(region_letter(k) + ": " + stable_words(chart, r)));
    }
  }
  if (items.empty()) add("NaN notitle");
  script += fmt::format("set title {}.\"\\n\".{} offset 0,0.3\n", quoted(title),
                        quoted(parameters_text(chart.study, {plane.x.key, plane.y.key}) +
                               (plane.one_of_many() ? words::stability::of_spread_balls : "") +
                               (chart.complete ? "" : words::plots::partial_early)));
  script += fmt::format("set xlabel {}\nset ylabel {} offset -0.6,0\n", quoted(x.label), quoted(y.label));
  script += fmt::format("set xrange [{:.10g}:{:.10g}]\nset yrange [{:.10g}:{:.10g}]\n", plane.x.low * x.factor,
                        plane.x.high * x.factor, plane.y.low * y.factor, plane.y.high * y.factor);
  script +=
      "set border linecolor rgb '#444444'\nset tics nomirror out textcolor rgb '#222222'\n"
      "set key outside right top vertical Left reverse samplen 2.2 width 1 ";
  // In one column: a second one takes the plane's room.
  const auto lines = std::count(items.begin(), items.end(), '\n');
  script += lines > 14 ? fmt::format("font ',{}' spacing 1.05\n", lines > 24 ? 9 : 13) : "spacing 1.3\n";
  return script + "plot " + items + "\n";
}

}  // namespace equipoise
