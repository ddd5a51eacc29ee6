// The rows of drawings on the page for one machine: runs; bars, motions and distributions; with their captions.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "equipoise/report/text/motion_words.hpp"
#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

constexpr char at_the_end[] = " at the end";
using study::Dimension;

constexpr SvgPoint top_left{52.0, 16.0}, bottom_right{264.0, 130.0};
constexpr double plot_width = 272.0, plot_height = 166.0;

AxisExtent time_extent(const MachinePage& page) {
  double end = 0.0;
  for (const ShownRun& run : page.runs) end = std::max(end, run.t.back());
  return {0.0, end};
}

const char* colour_of_run(RunOf of) {
  return of == RunOf::bare ? "var(--bare)" : of == RunOf::median ? "var(--typical)" : "var(--worst)";
}

double highest_of(const MachinePage& page) {
  double highest = 0.0;
  for (const ShownRun& run : page.runs)
    highest = std::max(highest, *std::max_element(run.r_high.begin(), run.r_high.end()));
  return highest;
}

// Whose run it is, in words.
std::string run_name(const MachinePage& page, const ShownRun& run) {
  if (run.of == RunOf::bare) return "without balls";
  constexpr std::uint64_t hundred = 100;
  if (run.of == RunOf::worst_in_hundred)
    return page.starts_drawn >= hundred ? "worst in a hundred" : fmt::format("worst of {} starts", page.starts_drawn);
  const bool all = std::none_of(page.runs.begin(), page.runs.end(),
                                [](const ShownRun& r) { return r.of == RunOf::worst_in_hundred; });
  return all ? "with balls" : "typical start, half peak lower";
}

// Whether all runs turn alike, as far as can be seen: a motor may feel vibration.
bool turn_alike(const std::vector<ShownRun>& runs) {
  constexpr double seen = 0.01;
  const std::vector<double>& first = runs.front().speed;
  const double most = std::fabs(
      *std::max_element(first.begin(), first.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); }));
  return std::all_of(runs.begin(), runs.end(), [&](const ShownRun& run) {
    return std::equal(first.begin(), first.end(), run.speed.begin(), run.speed.end(),
                      [&](double a, double b) { return std::fabs(a - b) <= seen * most; });
  });
}

// Rotor speeds in round numbers, and when all runs come to them; empty where the speed is constant, falls or differs.
struct SpeedScale {
  std::vector<double> times;
  std::vector<std::string> words;
  std::string label;
};
SpeedScale speed_scale(const MachinePage& page) {
  const Study& study = page.basin.study;
  if (page.runs.empty() || study.speed.profile == Profile::constant || !turn_alike(page.runs)) return {};
  std::vector<double> speed = page.runs.front().speed;
  const std::vector<double>& time = page.runs.front().t;
  for (double& s : speed) s = std::fabs(s);
  if (!(speed.back() > speed.front())) return {};
  for (std::size_t k = 1; k < speed.size(); ++k) {
    constexpr double rounded = 1e-9;  // means over stretches of one speed
    if (speed[k] < speed[k - 1] - rounded * speed.back()) return {};
    speed[k] = std::max(speed[k], speed[k - 1]);
  }
  const AxisWords axis = PageQuantities(study).axis("speed", speed.back(), Dimension::speed);
  SpeedScale scale{{}, {}, axis.label};
  constexpr int ticks = 6;
  constexpr double rounding = 1.0 + 1e-6;
  for (const double tick : round_ticks({speed.front() * axis.factor, speed.back() * axis.factor * rounding}, ticks)) {
    const double wanted = tick / axis.factor / rounding;
    const auto above = std::lower_bound(speed.begin(), speed.end(), wanted);
    if (above == speed.end()) break;
    const auto k = static_cast<std::size_t>(above - speed.begin());
    const double part = k == 0 ? 0.0 : (wanted - speed[k - 1]) / (speed[k] - speed[k - 1]);
    scale.times.push_back(k == 0 ? time[0] : time[k - 1] + part * (time[k] - time[k - 1]));
    scale.words.push_back(fmt::format("{:.6g}", tick));
  }
  return scale;
}

std::string shares_svg(const MachinePage& page) {
  const std::vector<OutcomeShare> lines = page.basin.outcomes_met();
  constexpr double row = 34.0, left = 4.0, right = 300.0, thick = 12.0;
  Svg svg(right + 8.0, row * static_cast<double>(lines.size()) + 6.0,
          "Shares of starts by outcome, with their intervals");
  const auto place = [&](double share) { return left + share * (right - left); };
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const OutcomeShare& line = lines[k];
    const double top = row * static_cast<double>(k) + 17.0, middle = top + 0.5 * thick;
    svg.text({left, top - 4.0}, reader_title(line, page.basin.study.scales.has_value()));
    svg.text({right, top - 4.0}, share_text(line.share), SvgAnchor::end);
    svg.rectangle({left, top}, right - left, thick, {"", "var(--rule)", 1.0, 0.45});
    svg.rectangle({left, top}, place(line.share.share) - left, thick, {"", colour_of(line.id)});
    // The whisker must stand out both on its bar and next to it.
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
  Svg svg(plot_width, plot_height, "Speed of the rotor over time");
  SvgAxes axes(svg, top_left, bottom_right, time, speed, shown.axis("time", time.high, Dimension::time),
               shown.axis("speed", std::max(speed.high, -speed.low), Dimension::speed));
  const std::size_t lines =
      page.basin.study.speed.driven() ? page.runs.size() : std::size_t{1};  // the same at a prescribed speed
  for (std::size_t k = lines; k-- > 0;)
    axes.line(page.runs[k].t, page.runs[k].speed, {colour_of_run(page.runs[k].of), "", 1.6});
  return svg.str();
}

std::string runs_caption(const MachinePage& page) {
  const Study& study = page.basin.study;
  std::string text =
      study.bearings.empty()
          ? "Distance of the rotor's centre from its place at rest; shaded: swings too fast to be drawn."
          : "Distance of the shaft from its place at rest, at the bearing where it is largest; shaded: swings too "
            "fast to be drawn.";
  std::string numbers;
  for (const ShownRun& run : page.runs) {
    if (run.of == RunOf::bare) {
      if (!study.uncertain.empty() && page.runs.size() > 1) text += " Without balls: the rotor of the typical start.";
      continue;
    }
    numbers += fmt::format("{}start {} is the {}", numbers.empty() ? "" : ", ", run.index,
                           run.of == RunOf::median ? "typical one" : "worst in a hundred");
    // Starts near the boundary of two basins may go another way if the last digit differs.
    constexpr double alike = 0.02;
    if (std::fabs(run.again - run.peak) > alike * run.peak)
      numbers += fmt::format(" (followed again with smaller steps, {} within what is shown)",
                             PageQuantities(study).text(run.again, Dimension::length));
  }
  return numbers.empty() ? text : fmt::format("{} With this seed, {}.", text, numbers);
}

}  // namespace

std::string run_words(const MachinePage& page, const ShownRun& run) {
  const PageQuantities shown(page.basin.study);
  std::string text = fmt::format("{}: peak {}; ", run_name(page, run), shown.text(run.peak, Dimension::length));
  constexpr double seen = 0.005;  // of the picture's height
  const std::string level = shown.text(run.at_end, Dimension::length);
  if (run.of == RunOf::bare) return text + level + at_the_end;
  text += reader_title(run.outcome, page.basin.study.scales.has_value()) + at_the_end;
  return run.at_end > seen * highest_of(page) ? text + ", " + level : text;
}

bool run_up_tells_speed(const MachinePage& page) {
  return page.basin.study.speed.profile == Profile::constant || !speed_scale(page).times.empty();
}

std::string run_up_svg(const MachinePage& page) {
  const Study& study = page.basin.study;
  const PageQuantities shown(study);
  const AxisExtent time = time_extent(page);
  double highest = highest_of(page);
  const auto& limit = study.limits.displacement;
  constexpr double near_enough = 1.6;
  if (limit && *limit < near_enough * highest) highest = std::max(highest, *limit);
  const SpeedScale speed = speed_scale(page);
  constexpr double width = 720.0, row = 16.0, plot = 160.0, below = 36.0;
  const double top = row * static_cast<double>(page.runs.size()) + (speed.times.empty() ? 14.0 : 44.0);
  Svg svg(width, top + plot + below, "Displacement of the rotor over time, with and without balls");
  SvgAxes axes(svg, {52.0, top}, {width - 8.0, top + plot}, time, {0.0, 1.15 * std::max(highest, 1e-12)},
               shown.axis("time", time.high, Dimension::time), shown.axis("displacement", highest, Dimension::length));
  if (!speed.times.empty()) axes.scale_above(speed.times, speed.words, speed.label);
  for (std::size_t k = page.runs.size(); k-- > 0;) {  // the worst below all others
    const ShownRun& run = page.runs[k];
    const char* colour = colour_of_run(run.of);
    axes.band(run.t, run.r_low, run.r_high, {"", colour, 0.0, 0.22});
    axes.line(run.t, run.r_high, {colour, "", run.of == RunOf::bare ? 2.0 : 1.4});
    const double line = row * static_cast<double>(k) + 7.0;
    svg.line({52.0, line}, {76.0, line}, {colour, "", run.of == RunOf::bare ? 2.6 : 2.0});
    svg.text({83.0, line + 4.0}, run_words(page, run), SvgAnchor::start, {}, 12.0);
  }
  if (limit) axes.limit_across(*limit, "limit " + shown.text(*limit, Dimension::length));
  return svg.str();
}

DrawingRow run_up_drawing(const MachinePage& page) {
  return {{{"", run_up_svg(page)}}, runs_caption(page), DrawingSize::whole};
}

DrawingRow ends_drawing(const MachinePage& page) {
  const Study& study = page.basin.study;
  DrawingRow row{{{"", shares_svg(page)}}};
  for (const DrawnMotion& motion : page.motions)
    if (!motion.x.empty()) row.drawings.push_back(motion_drawing(page, motion));
  for (const FigureDistribution& d : page.peaks)
    row.drawings.push_back({capitalised(d.limited->figure().title) + ", all starts", distribution_svg(page, d)});
  if (!page.runs.empty() && !run_up_tells_speed(page)) row.drawings.push_back({"Speed over time", speed_svg(page)});
  row.caption =
      study.parameters.tilts()
          ? fmt::format(
                "Bars: shares of starts with 95 % intervals. Circles: left, the balls in their races as seen from "
                "the turning rotor, that with the largest place along the shaft outermost, with arrows where balls "
                "move; right, the path of the shaft {}, as seen from the side of the machine, all to one scale",
                study.bearings.empty() ? "at the centre of mass" : "at the outermost bearing that moves more")
          : "Bars: shares of starts with 95 % intervals. Circles: left, the balls in the race as seen from the "
            "turning rotor, with a wedge at its heavy side and arrows where balls move; right, the path of the "
            "rotor's centre as seen from the side of the machine, all to one scale";
  row.caption += study.limits.displacement ? ", the limit dashed if it lies within the drawing." : ".";
  if (page.motions_left_out > 0) row.caption += fmt::format(" {} rarer not drawn.", page.motions_left_out);
  if (page.starts_drawn < page.basin.starts)
    row.caption += fmt::format(" Peaks and runs are of the first {} starts.", page.starts_drawn);
  return row;
}

}  // namespace equipoise
