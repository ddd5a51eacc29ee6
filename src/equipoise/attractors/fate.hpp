// What became of one start.
#pragma once

#include <array>

#include "equipoise/attractors/decision_rule.hpp"

namespace equipoise {

/// Outcomes of a start. The numbers are stored in result files.
enum class Outcome : signed char {
  balanced = 0,      ///< entered a level set that leads to a linearly stable balanced state
  not_balanced = 1,  ///< came to a stationary motion away from balance
  undecided = 2,     ///< neither by the horizon
  diverged = 3,      ///< left every motion a balancer can make (divergence_limit)
  failed = 4,        ///< the integrator's step size vanished
};
inline constexpr int outcome_count = 5;
inline constexpr std::array<const char*, outcome_count> outcome_names{"balanced", "not balanced", "undecided",
                                                                      "diverged", "failed"};

struct Fate {
  Outcome outcome = Outcome::undecided;
  double time = 0.0;  ///< study time at which it was known
};

/// What the pilot keeps of a stationary motion: its long-window features and the range of its short-window features.
struct PilotRecord {
  Features features{};
  FeatureBox range;
  bool stationary = false;  ///< false: this start came to no such motion
};

}  // namespace equipoise
