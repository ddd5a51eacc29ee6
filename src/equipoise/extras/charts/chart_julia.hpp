// Points of a chart's curves for BifurcationKit.jl.
#pragma once

#include <string>

#include "equipoise/extras/planes/bifurcation_chart.hpp"

namespace equipoise {

/// A script in Julia: the study, the points with states and eigenvalues, and a function that makes a problem for
/// BifurcationKit.jl of a point. The equations are those of the Python package, called through PythonCall.jl. Empty
/// under a motor, whose states are not those of the package's equations.
std::string chart_julia(const BifurcationChart& chart);

}  // namespace equipoise
