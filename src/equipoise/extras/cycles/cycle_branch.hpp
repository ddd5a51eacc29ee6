// Cycles, such as those born at a Hopf point, followed along a line of parameters, and what happens to them on the way.
// This room: cycles born at a Hopf point: their equations, test functions, branches along a line of parameters.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/extras/cycles/cycle_shooting.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// Systems by place in a plane of parameters, which is the unit square; empty where there is none.
using CycleSystems = std::function<std::optional<model::System>(const Eigen::VectorXd&)>;

struct CycleStart {
  Eigen::VectorXd at;         ///< a Hopf point
  Eigen::VectorXd direction;  ///< in which parameters change, either way, of length 1
  Eigen::VectorXd state;      ///< at rest there
  double frequency = 0.0;
};

struct CyclePlace {
  Eigen::VectorXd at;
  CycleShape shape;
  Eigen::VectorXcd multipliers;  ///< but that of a shift in time
  double swing = 0.0;            ///< see cycle_swing()
};

struct CycleCrossing {
  CurveKind change = CurveKind::cycle_fold;
  CyclePlace near;
  double cosine = 0.0;  ///< of the angle of a torus's pair
  double birth_period = 0.0;
};

struct CycleBranch {
  std::vector<CyclePlace> places;
  std::vector<CycleCrossing> crossings;
  std::vector<std::size_t> behind;  ///< of every crossing: the number of places before it
  bool left = false;                ///< ends where it leaves the square: its last place is on the border
};

/// A branch has at most this many points.
inline constexpr std::size_t most_of_branch = 400;
/// With a larger one the others are lost in errors of integration.
inline constexpr double largest_cycle_multiplier = 1e6;

/// From small cycles on, until the branch leaves the square, its cycles shrink again, or their period passes
/// longest_period(). Where a multiplier passes 1 without a turn of the branch (symmetry breaks) nothing is noted.
CycleBranch cycle_branch(const CycleSystems& systems, const CycleStart& start, const StopFlag* stop);

/// From this cycle at `at` on, its first place, in a direction of length 1, until the branch leaves the square (a place
/// on the border is then its last) or its period passes longest_period(). Folds are passed.
CycleBranch cycle_branch(const CycleSystems& systems, const Eigen::VectorXd& at, const Eigen::VectorXd& direction,
                         const CycleShape& cycle, const StopFlag* stop);

/// Multipliers outside the unit circle.
int unstable_multipliers(const Eigen::VectorXcd& multipliers);

}  // namespace equipoise
