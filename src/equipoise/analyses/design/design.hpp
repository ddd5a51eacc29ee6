// Design: the best balancer and spin-up for a machine that a budget of trajectories can find.
// This room: candidates as studies, the search, its checks and margins.
#pragma once

#include <functional>

#include "equipoise/analyses/design/problem.hpp"
#include "equipoise/analyses/sweeps/survey.hpp"
#include "equipoise/results/commands/design_result.hpp"

namespace equipoise {

/// Progress is in trajectories.
struct DesignOptions : SurveyOptions {
  /// Says, from any thread, that the search has had its time; the best by then is still checked. Empty: the budget
  /// says.
  std::function<bool()> search_time_over;
};

/// A block is a candidate: what is known of it is what is wanted (WantedSample), what is made of it the ensemble
/// (KeptSample, unnamed). Searches the study as it is before it returns, with the threads and stop flag of `options`.
Survey design_survey(const DesignProblem& problem, const RunOptions& options);

/// Searches with two thirds of the budget, all candidates on the same starts; follows the best with more of them;
/// judges the front on starts that the search did not see; and moves the numbers of the chosen one, each by itself. The
/// result depends on the problem alone. Stopped, it shows what the search has found by then. Throws InputError for
/// unusable output files, RunError if the output fails later.
DesignResult design(const DesignProblem& problem, const DesignOptions& options = {});

}  // namespace equipoise
