// A picture of the curves on which balance and locked states change.
#pragma once

#include <string>

#include "equipoise/extras/planes/bifurcation_chart.hpp"

namespace equipoise {

/// A picture file (SVG): boxes in which something is proved, shaded by what; curves, solid where a stable balance loses
/// its stability softly, dashed where abruptly, thin where it was unstable before; those of locked states in colour;
/// special points; letters of regions. `title` goes before the parameters.
std::string chart_plot(const BifurcationChart& chart, const std::string& title);

}  // namespace equipoise
