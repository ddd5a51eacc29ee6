// A picture of branches, as a gnuplot script that contains the data.
#pragma once

#include <string>

#include "equipoise/results/branches_result.hpp"

namespace equipoise {

/// Draws r_min to r_max of every branch against the parameter into `path` (.png or .svg): a band where the motion
/// attracts, dashed lines where it is unstable. An identifier has the same colour in all pictures.
std::string branch_plot_script(const BranchesResult& result, const std::string& path);

}  // namespace equipoise
