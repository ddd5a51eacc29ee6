// A picture of a sweep, as a script for gnuplot with the data in it.
#pragma once

#include <string>

#include "equipoise/results/sweep_result.hpp"

namespace equipoise {

/// Along one axis: shares stacked, one colour an identifier, with the interval of balance. Over two: the balanced share
/// as a heat map; over three, one such map a value of the first axis. `path`: .png or .svg.
std::string sweep_plot_script(const SweepResult& result, const std::string& title, const std::string& path);

}  // namespace equipoise
