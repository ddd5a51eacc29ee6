// The rows of pictures on the page for one machine, with their captions.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/report/answers/quantities.hpp"
#include "equipoise/report/decision/plain_names.hpp"
#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/report/plots/plots.hpp"

namespace equipoise {

namespace {
using study::Dimension;

// "the balls rest in the race"; "ball 1 rests, ball 2 falls behind by 0.9 ω_c".
std::string ball_words(const PageQuantities& shown, const DrawnMotion& m) {
  constexpr double still = 0.01;  // rad: in a race of 0.1 m they move by a millimetre
  std::vector<std::string> does;
  for (const BallOnMotion& b : m.balls) {
    const bool behind = b.drift * (m.speed < 0.0 ? -1.0 : 1.0) < 0.0;
    does.push_back(b.drift != 0.0           ? fmt::format("{} by {}", behind ? "behind" : "ahead",
                                                          shown.text(std::fabs(b.drift), Dimension::speed))
                   : b.high - b.low < still ? "rest"
                                            : "swing");
  }
  const auto words = [](const std::string& what, bool one) {
    if (what == "rest") return std::string(one ? "rests in the race" : "rest in the race");
    if (what == "swing") return std::string(one ? "swings about its place" : "swing about their places");
    return (what.starts_with("behind") ? one ? "falls " : "fall " : one ? "runs " : "run ") + what;
  };
  if (std::all_of(does.begin(), does.end(), [&](const std::string& one) { return one == does.front(); }))
    return does.size() == 1 ? "the ball " + words(does[0], true) : "the balls " + words(does[0], false);
  std::string text;
  for (std::size_t i = 0; i < does.size(); ++i)
    text += fmt::format("{}ball {} {}", i ? ", " : "", i + 1, words(does[i], true));
  return text;
}

std::string motion_words(const Study& study, const DrawnMotion& m) {
  const PageQuantities shown(study);
  const bool rests = m.r_max < 1e-9;
  std::string text = rests ? "The centre rests on the axis" : "The centre is ";
  if (m.bearing)
    text = fmt::format(fmt::runtime(rests ? "At {} the shaft rests on the axis" : "At {} the shaft is "),
                       shown.text(*m.bearing, Dimension::length));
  if (!rests) text += shown.range(m.r_min, m.r_max, Dimension::length) + " off the axis";
  if (study.speed.driven()) text += fmt::format(" at {}", shown.text(m.speed, Dimension::speed));
  text += "; " + ball_words(shown, m);
  text += ".";
  if (m.one_start) text += " Drawn from the end of one start.";
  if (m.continuum) text += " One of a continuum of such motions.";
  return text;
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
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

DrawingRow run_up_drawing(const MachinePage& page) {
  DrawingRow row;
  row.whole = true;
  row.drawings.push_back({"", run_up_svg(page), "", ""});
  row.caption = runs_caption(page);
  return row;
}

DrawingRow ends_drawing(const MachinePage& page) {
  const Study& study = page.basin.study;
  DrawingRow row;
  row.drawings.push_back({"", shares_svg(page), "", ""});
  for (const DrawnMotion& motion : page.motions)
    if (!motion.x.empty())
      row.drawings.push_back({reader_title(motion, study.scales.has_value()), motion_svg(page, motion),
                              motion_words(study, motion), colour_of(motion.id)});
  for (const FigureDistribution& d : page.peaks)
    row.drawings.push_back({capital(d.limited->figure().title) + ", all starts", distribution_svg(page, d), "", ""});
  if (!page.runs.empty() && !run_up_tells_speed(page))
    row.drawings.push_back({"Speed over time", speed_svg(page), "", ""});
  row.caption =
      study.parameters.tilts()
          ? fmt::format(
                "Bars: shares of starts with 95 % intervals. Circles: left, the balls in their races as seen from "
                "the turning rotor, that with the largest place along the shaft outermost, with arrows where balls "
                "move; right, the path of the shaft {}, as seen from beside the machine, all to one scale",
                study.bearings.empty() ? "at the centre of mass" : "at the outermost bearing that moves more")
          : "Bars: shares of starts with 95 % intervals. Circles: left, the balls in the race as seen from the "
            "turning rotor, with a wedge at its heavy side and arrows where balls move; right, the path of the "
            "rotor's centre as seen from beside the machine, all to one scale";
  row.caption += study.limits.displacement ? ", the limit dashed if it lies within the drawing." : ".";
  if (page.motions_left_out > 0) row.caption += fmt::format(" {} rarer not drawn.", page.motions_left_out);
  if (page.starts_drawn < page.basin.starts)
    row.caption += fmt::format(" Peaks and runs are of the first {} starts.", page.starts_drawn);
  return row;
}

}  // namespace equipoise
