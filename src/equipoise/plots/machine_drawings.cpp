// Bars, distributions and runs.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "equipoise/drawing/plot_parts.hpp"
#include "equipoise/plots/drawings.hpp"
#include "equipoise/plots/quantities.hpp"
#include "equipoise/text/text.hpp"

namespace equipoise {

namespace {
using study::Dimension;

constexpr SvgPoint top_left{52.0, 16.0}, bottom_right{334.0, 158.0};
constexpr double plot_width = 342.0, plot_height = 196.0;

double end_of(const ShownRun& run) { return run.t.back(); }

AxisExtent time_extent(const MachinePage& page) {
  double end = 0.0;
  for (const ShownRun& run : page.runs) end = std::max(end, end_of(run));
  return {0.0, end};
}

}  // namespace

const char* run_colour(std::size_t place) { return place == 0 ? "var(--typical)" : "var(--worst)"; }

std::string shares_svg(const MachinePage& page) {
  const std::vector<OutcomeShare> lines = page.basin.outcomes_met();
  constexpr double row = 34.0, left = 4.0, right = 330.0, thick = 12.0;
  Svg svg(plot_width, row * static_cast<double>(lines.size()) + 6.0,
          "Shares of starts by outcome, with their intervals");
  const auto place = [&](double share) { return left + share * (right - left); };
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const OutcomeShare& line = lines[k];
    const double top = row * static_cast<double>(k) + 17.0, middle = top + 0.5 * thick;
    svg.text({left, top - 4.0}, line.name);
    svg.text({right, top - 4.0}, percent(line.share.share, line.share.count == 0 ? 0 : digits_for(line.share)),
             SvgAnchor::end);
    svg.rectangle({left, top}, right - left, thick, {"", "var(--rule)", 1.0, 0.45});
    svg.rectangle({left, top}, place(line.share.share) - left, thick, {"", colour_of(line.id)});
    // The whisker must stand out both on its bar and beside it.
    const double low = place(line.share.low), high = place(line.share.high);
    for (const SvgPen& pen : {SvgPen{"var(--paper)", "", 4.0}, SvgPen{ink, "", 1.6}}) {
      svg.line({low, middle}, {high, middle}, pen);
      for (const double end : {low, high}) svg.line({end, middle - 4.0}, {end, middle + 4.0}, pen);
    }
  }
  return svg.str();
}

std::string distribution_svg(const MachinePage& page, const FigureDistribution& d) {
  const Study& study = page.basin.study;
  const TransientFigure& figure = d.limited->figure();
  const PageQuantities shown(study);
  const std::size_t bins = d.outcomes.empty() ? 0 : d.outcomes.front().bins.size();
  std::vector<double> height(bins, 0.0);
  for (const auto& outcome : d.outcomes)
    for (std::size_t k = 0; k < bins; ++k) height[k] += outcome.bins[k];
  const double highest = bins == 0 ? 1.0 : *std::max_element(height.begin(), height.end());
  Svg svg(plot_width, plot_height, fmt::format("Distribution of the {}", figure.title));
  SvgAxes axes(svg, top_left, bottom_right, {d.low, d.high}, {0.0, 1.08 * highest},
               shown.axis(figure.title, d.high, *figure.dimension), {"starts, %", 100.0});
  std::fill(height.begin(), height.end(), 0.0);
  const double width = (d.high - d.low) / static_cast<double>(std::max<std::size_t>(bins, 1));
  for (const auto& outcome : d.outcomes)
    for (std::size_t k = 0; k < bins; ++k) {
      if (outcome.bins[k] <= 0.0) continue;
      const double from = d.low + static_cast<double>(k) * width;
      axes.bar(from, from + 0.92 * width, height[k], height[k] + outcome.bins[k], {"", colour_of(outcome.code)});
      height[k] += outcome.bins[k];
    }
  if (const auto& limit = study.limits.*d.limited->limit)
    axes.limit_up(*limit, "limit " + shown.text(*limit, *figure.dimension));
  return svg.str();
}

std::string displacement_svg(const MachinePage& page) {
  const Study& study = page.basin.study;
  const PageQuantities shown(study);
  const AxisExtent time = time_extent(page);
  double highest = 0.0;
  for (const ShownRun& run : page.runs)
    highest = std::max(highest, *std::max_element(run.r_high.begin(), run.r_high.end()));
  const auto& limit = study.limits.displacement;
  constexpr double near_enough = 1.6;
  if (limit && *limit < near_enough * highest) highest = std::max(highest, *limit);
  Svg svg(plot_width, plot_height, "Displacement over time of a typical start and of the worst");
  SvgAxes axes(svg, top_left, bottom_right, time, {0.0, 1.1 * std::max(highest, 1e-12)},
               shown.axis("time", time.high, Dimension::time), shown.axis("displacement", highest, Dimension::length));
  for (std::size_t k = page.runs.size(); k-- > 0;) {  // the typical one on top
    const ShownRun& run = page.runs[k];
    axes.band(run.t, run.r_low, run.r_high, {run_colour(k), run_colour(k), 0.9, 0.75});
  }
  if (limit) axes.limit_across(*limit, "limit " + shown.text(*limit, Dimension::length));
  return svg.str();
}

std::string speed_svg(const MachinePage& page) {
  const PageQuantities shown(page.basin.study);
  const AxisExtent time = time_extent(page);
  AxisExtent speed{0.0, 0.0};
  for (const ShownRun& run : page.runs) {
    const auto [low, high] = std::minmax_element(run.speed.begin(), run.speed.end());
    speed = {std::min(speed.low, *low), std::max(speed.high, *high)};
  }
  const double room = 0.08 * std::max(speed.high - speed.low, 1e-12);
  speed = {speed.low < 0.0 ? speed.low - room : 0.0, speed.high > 0.0 ? speed.high + room : 0.0};
  Svg svg(plot_width, plot_height, "Speed over time of a typical start and of the worst");
  SvgAxes axes(svg, top_left, bottom_right, time, speed, shown.axis("time", time.high, Dimension::time),
               shown.axis("speed", std::max(speed.high, -speed.low), Dimension::speed));
  const std::size_t lines =
      page.basin.study.speed.driven() ? page.runs.size() : std::size_t{1};  // the same at a prescribed speed
  for (std::size_t k = lines; k-- > 0;) axes.line(page.runs[k].t, page.runs[k].speed, {run_colour(k), "", 1.6});
  return svg.str();
}

}  // namespace equipoise
