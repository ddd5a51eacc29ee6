// How far each number of the chosen candidate may change, all others fixed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/analyses/design/ensembles.hpp"
#include "equipoise/analyses/design/problem.hpp"
#include "equipoise/analyses/design/standing.hpp"
#include "equipoise/results/commands/design_result.hpp"

namespace equipoise {

/// Changes every number of the candidate to either side by parts of its range, or to its other choices, on the held-out
/// starts; for a spin-up each point's speed and time. By effect, the largest first. Throws SearchOver if stopped.
std::vector<DesignMargin> design_margins(const DesignProblem& problem, const DesignStanding& standing,
                                         DesignEnsembles& ensembles, const DesignCandidate& chosen,
                                         std::uint64_t starts, std::uint64_t seed);
/// Number of ensembles that this takes.
std::size_t margin_points(const DesignProblem& problem);

/// In words: limits that are just met or missed, and variables at an end of their range.
std::vector<std::string> design_limits_reached(const DesignProblem& problem, const DesignStanding& standing,
                                               const DesignCandidate& chosen);

}  // namespace equipoise
