// Design: the best balancer and spin-up for a machine that a budget of trajectories can find.
#pragma once

#include <string>

#include "equipoise/design/problem.hpp"
#include "equipoise/results/design_result.hpp"
#include "equipoise/running/run_options.hpp"

namespace equipoise {

/// Progress is in trajectories.
struct DesignOptions : RunOptions {
  std::string output;  ///< NetCDF file; an unfinished one of the same design is resumed, a finished one read
};

/// Searches with two thirds of the budget, with the same starts for all candidates; follows the best with more of them;
/// judges the front on starts that the search did not see; and changes each number of the chosen candidate alone. The
/// result depends only on the problem. If stopped, it holds what the search had found. Throws InputError for unusable
/// output files, RunError if the output fails later.
DesignResult design(const DesignProblem& problem, const DesignOptions& options = {});

}  // namespace equipoise
