// A picture of branches, as a script for gnuplot with the data in it.
#pragma once

#include <string>

#include "equipoise/results/branches_result.hpp"

namespace equipoise {

/// Draws r_min to r_max of every branch against the parameter into `path` (.png or .svg): a band where the motion
/// attracts, dashed lines where it is unstable, one colour an identifier in all pictures.
std::string branch_plot_script(const ContinuationResult& result, const std::string& path);

}  // namespace equipoise
