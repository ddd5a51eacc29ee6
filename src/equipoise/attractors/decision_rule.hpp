// How a trajectory's fate is recognised at the final speed: data shared by all lanes.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "equipoise/model/parameters.hpp"

namespace equipoise {

inline constexpr int max_dimension = model::dimension(model::max_balls);

/// A linearly stable balanced state and a level set of a Lyapunov function around it, inside which that function
/// decreases along the full nonlinear flow: whoever enters stays and ends balanced.
struct BalancedTrap {
  std::array<double, model::max_balls> phi{};  ///< ball angles of the balanced state
  /// Upper triangular F, row-major dimension x dimension: the Lyapunov function of a deviation d is V = |F d|^2.
  std::vector<double> factor;
  double level = 0.0;                         ///< inside: V < level
  std::array<double, max_dimension> reach{};  ///< no point inside deviates further in that component
};

/// Features of a window: smallest, largest and root-mean-square r; then for each ball mean, smallest and largest rate
/// phi'. Interchangeable balls are sorted by mean rate. feature_count(balls) of them are used.
using Features = std::array<double, 3 + 3 * model::max_balls>;
constexpr int feature_count(int balls) { return 3 + 3 * balls; }

/// Bounds on the features of short windows.
struct FeatureBox {
  Features low{}, high{};
};

/// Decides for states near a continuum of balanced states whether they are caught by it (three balls or more).
struct FamilyTrap {
  double reach = 0.0;  ///< asked only when all velocities, x, y and imbalance are below this
  std::function<bool(const double* state)> caught;  ///< thread-safe
};

struct DecisionRule {
  int balls = 2;
  bool interchangeable = true;  ///< equal balls: features do not depend on their order
  std::vector<BalancedTrap> traps;
  FamilyTrap family;                 ///< `caught` empty: no continuum
  double window = 16.0;              ///< length of a short window
  double first_long_window = 100.0;  ///< long windows end at this time and at its doublings
  double sameness = 0.02;            ///< relative change between long windows that counts as none
  int hits_needed = 3;               ///< successive short windows inside one box
  int repeats_needed = 2;            ///< successive long windows that repeat the one before
  std::vector<FeatureBox> boxes;     ///< motions found by the pilot
};

}  // namespace equipoise
