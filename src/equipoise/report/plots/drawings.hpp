// The pictures on the page for one machine, as SVG (report/drawing/svg.hpp). They need no script, no other program and
// no light background, and print as lines.
// This room: results as pictures.
#pragma once

#include <string>

#include "equipoise/results/commands/machine_page.hpp"

namespace equipoise {

/// Bars by outcome, with their intervals.
std::string shares_svg(const MachinePage& page);

/// The balls in their race, in the rotating frame; beside it the path of the rotor's centre in fixed axes, to one scale
/// for all motions of the page.
std::string motion_svg(const MachinePage& page, const DrawnMotion& motion);

/// Stacked bars by outcome, with the limit if the study has one.
std::string distribution_svg(const MachinePage& page, const FigureDistribution& distribution);

/// The page's main picture: the displacement of every shown run against time, with the limit if there is one and a
/// legend in words; above it the speed, where that is the same in all runs and never falls.
std::string run_up_svg(const MachinePage& page);
/// Whether run_up_svg() says how fast the rotor turns when: it need not at a constant speed.
bool run_up_tells_speed(const MachinePage& page);
/// The speed of the shown runs against time; one line where it is prescribed.
std::string speed_svg(const MachinePage& page);

/// "typical start, half peak lower: peak 26.5 mm; balanced at the end", "without balls: peak 10.6 mm; 2.58 mm at the
/// end".
std::string run_words(const MachinePage& page, const ShownRun& run);

}  // namespace equipoise
