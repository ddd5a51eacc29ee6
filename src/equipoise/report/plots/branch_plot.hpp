// A picture of branches.
#pragma once

#include <string>

#include "equipoise/results/commands/branch.hpp"

namespace equipoise {

/// A picture file (SVG) of r_min to r_max of every branch against the parameter: a band where the motion attracts,
/// dashed lines where it is unstable. An identifier has the same colour in all pictures. `title` goes before the
/// parameters.
std::string branch_plot(const BranchesResult& result, const std::string& title);

}  // namespace equipoise
