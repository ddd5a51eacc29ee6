// A picture of a sweep, as a gnuplot script that contains the data.
#pragma once

#include <string>

#include "equipoise/results/sweep_result.hpp"

namespace equipoise {

/// Along one axis: stacked shares with the interval of balance; an identifier has the same colour in all pictures. Over
/// two axes: the balanced share as a heat map; over three, one such map per value of the first. `path`: .png or .svg.
std::string sweep_plot_script(const SweepResult& result, const std::string& title, const std::string& path);

}  // namespace equipoise
