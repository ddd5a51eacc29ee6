// A picture of the curves on which balance and locked states change, as a gnuplot script that contains the data.
#pragma once

#include <string>

#include "equipoise/planes/bifurcation_chart.hpp"

namespace equipoise {

/// Draws into `path` (.png or .svg): boxes in which something is proved, shaded by what; curves, solid where a stable
/// balance loses its stability softly, dashed where abruptly, thin where it was unstable before; those of locked
/// states in colour; special points; letters of regions.
std::string chart_plot_script(const BifurcationChart& chart, const std::string& title, const std::string& path);

}  // namespace equipoise
