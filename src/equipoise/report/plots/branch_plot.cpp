// Stretches of equal stability as bands between edges; legend.
#include "equipoise/report/plots/plots.hpp"

#include <algorithm>
#include <vector>

#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/results/commands/outcome_share.hpp"

namespace equipoise {

namespace {

constexpr double band = 0.25;  // opacity

struct Sample {
  double value, low, mean, high;
};
struct Stretch {
  bool stable = false;
  std::vector<Sample> samples;
};

// Ends and changes of stability are drawn where they were located, not only at the next value.
std::vector<Stretch> stretches_of(const Branch& branch) {
  std::vector<Stretch> stretches;
  auto event = branch.events.begin();
  const auto sample_of = [](const BranchEvent& e) { return Sample{e.place(), e.r_min, e.r_mean, e.r_max}; };
  std::size_t last = 0;
  for (const BranchPoint& point : branch.points) {
    const Motion& m = point.motion;
    if (stretches.empty() || point.at != last + 1) stretches.push_back({m.stable, {}});
    for (; event != branch.events.end() && event->middle() < point.value; ++event) {
      stretches.back().samples.push_back(sample_of(*event));
      if (event->change == BranchChange::stability_gained || event->change == BranchChange::stability_lost)
        stretches.push_back({m.stable, {sample_of(*event)}});
    }
    stretches.back().samples.push_back({point.value, m.r_min, m.r_mean, m.r_max});
    last = point.at;
  }
  for (; event != branch.events.end(); ++event) stretches.back().samples.push_back(sample_of(*event));
  return stretches;
}

using Edge = double Sample::*;

void draw_edge(Svg& svg, const SvgAxes& axes, const Stretch& stretch, Edge edge, const char* colour) {
  std::vector<SvgPoint> way;
  for (const Sample& s : stretch.samples) way.push_back(axes.at(s.value, s.*edge));
  if (way.size() == 1) return svg.circle(way.front(), 2.0, {"", colour});
  svg.path(way, {colour, "", stretch.stable ? 1.6 : 1.1, 1.0, !stretch.stable});
}

void draw_branch(Svg& svg, const SvgAxes& axes, const Branch& branch) {
  const char* colour = colour_of(branch.id);
  svg.group(legend_of(branch));
  for (const Stretch& stretch : stretches_of(branch)) {
    if (stretch.stable) {
      std::vector<SvgPoint> around;
      for (const Sample& s : stretch.samples) around.push_back(axes.at(s.value, s.low));
      for (auto s = stretch.samples.rbegin(); s != stretch.samples.rend(); ++s)
        around.push_back(axes.at(s->value, s->high));
      svg.path(around, {"", colour, 1.0, band}, true);
    }
    for (const Edge edge : {&Sample::low, &Sample::high}) draw_edge(svg, axes, stretch, edge, colour);
  }
  svg.end_group();
}

}  // namespace

std::string branch_plot(const BranchesResult& r, const std::string& title) {
  double highest = 0.0;
  std::vector<LegendEntry> legend;
  for (const Branch& b : r.branches) {
    legend.push_back({{colour_of(b.id), colour_of(b.id), 1.0, 2.0 * band}, legend_of(b)});
    for (const Stretch& stretch : stretches_of(b))
      for (const Sample& s : stretch.samples) highest = std::max(highest, s.high);
  }
  legend.push_back({{quiet_ink, "", 1.1, 1.0, true}, "unstable", LegendEntry::Mark::line});
  constexpr double width = 560.0, height = 380.0;
  const SvgPoint bottom_right{width - 14.0, height - 42.0};
  Svg svg(width, height, "Where the rotor can end");
  const double low = r.values.front(), high = r.values.back(), margin = high > low ? 0.0 : std::max(0.5 * r.step, 1e-9);
  const double top = 1.08 * std::max(highest, 1e-6);
  const SvgAxes axes(svg, drawing_top_left, bottom_right, {low - margin, high + margin}, {-0.012 * top, top},
                     {axis_label(r.key)}, {"rotor displacement r / race radius"});
  for (const Branch& b : r.branches) draw_branch(svg, axes, b);
  draw_legend(svg, legend);
  return plot_file(
      title, {parameters_text(r.study, {r.key}) + (r.partial ? " (PARTIAL: stopped early)" : "")},
      {{{"", svg.str()}}, "Every motion from its smallest to its largest displacement: a band where it attracts."});
}

}  // namespace equipoise
