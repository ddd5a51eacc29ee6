// Reference solutions, and how far a rival's end from them.
#pragma once

#include <vector>

#include "rivals/rival.hpp"

namespace equipoise::bench {

struct Reference {
  std::vector<double> states;       ///< final states, 8 numbers a trajectory
  double median = 0.0, most = 0.0;  ///< distance in (x, y) to a second, independent reference: over trajectories
};

/// How references are made, in words.
extern const char* const reference_method;

/// Final states of `starts` far more accurate than any rival's.
Reference make_reference(const Problem& problem, const std::vector<double>& starts, int threads);

/// Distance in (x, y) for each trajectory; infinite for one that was lost.
std::vector<double> errors(const std::vector<double>& states, const std::vector<double>& reference);

}  // namespace equipoise::bench
