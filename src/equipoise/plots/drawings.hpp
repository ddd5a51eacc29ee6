// The pictures on the page for one machine, as SVG (drawing/svg.hpp). They need no script, no other program and no
// light background, and print as lines.
#pragma once

#include <string>

#include "equipoise/results/machine_page.hpp"

namespace equipoise {

/// Bars by outcome, with their intervals.
std::string shares_svg(const MachinePage& page);

/// The balls in their race, in the rotating frame; beside it the path of the rotor's centre in fixed axes, to one scale
/// for all motions of the page.
std::string motion_svg(const MachinePage& page, const DrawnMotion& motion);

/// Stacked bars by outcome, with the limit if the study has one.
std::string distribution_svg(const MachinePage& page, const FigureDistribution& distribution);

/// The shown runs against time.
std::string displacement_svg(const MachinePage& page);
std::string speed_svg(const MachinePage& page);

/// Colour of the shown run number `place`.
const char* run_colour(std::size_t place);

}  // namespace equipoise
