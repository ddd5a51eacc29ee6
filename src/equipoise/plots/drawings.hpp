// The pictures of the page for one machine, as SVG (drawing/svg.hpp): they need no script, no other program and no
// light background, and print as lines.
#pragma once

#include <string>

#include "equipoise/results/machine_page.hpp"

namespace equipoise {

/// Bars by outcome with their intervals.
std::string shares_svg(const MachinePage& page);

/// The balls in their race, seen from the turning rotor, and beside it the way of the rotor's centre in fixed axes,
/// to the scale that all motions of the page have.
std::string motion_svg(const MachinePage& page, const DrawnMotion& motion);

/// Stacked bars by outcome, with the limit if the study has one.
std::string distribution_svg(const MachinePage& page, const FigureDistribution& distribution);

/// The shown runs over time.
std::string displacement_svg(const MachinePage& page);
std::string speed_svg(const MachinePage& page);

/// Of a shown run, by its place.
const char* run_colour(std::size_t place);

}  // namespace equipoise
