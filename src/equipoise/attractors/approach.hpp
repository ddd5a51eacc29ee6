// How a trajectory comes to its motion: what motion_from() knows besides the motion.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/attractors/motion.hpp"
#include "equipoise/model/system.hpp"

namespace equipoise {

/// Is a trajectory steady? is first asked after about this time, the longest a quick attractor takes to pull a start
/// in.
inline constexpr double first_stretch = 100.0;

/// Trajectories are followed at a tolerance that leaves r true to 1e-8.
inline constexpr double follow_tolerance = 1e-9;
/// Returns are looked for within the last part of a stretch: longer than any period met (pair drift, under 300).
inline constexpr double longest_memory = 1200.0;
inline constexpr int most_returns = 6;
/// A trajectory this close to a stable motion, in natural sizes, and still approaching has reached it.
inline constexpr double reached = 1e-3;
/// Farther than this from a stable motion nothing is concluded yet.
inline constexpr double in_reach = 0.5;

/// The stretches in which a trajectory is followed until it is steady, each as long as all before: as many as a time of
/// patience has room for, on section strobe in whole strobes.
class Stretches {
 public:
  Stretches(const model::System& system, double patience);

  bool strobed() const { return section_period_ > 0.0; }
  /// Between strobes; 0: there are none.
  double strobe() const { return section_period_; }
  /// About that time, at least one strobe.
  double whole(double time) const;
  double first() const { return first_; }
  /// That of all stretches together.
  double patience() const { return patience_; }
  bool are_over(double elapsed) const { return elapsed >= patience_ * (1.0 - 1e-9); }

 private:
  double section_period_, first_ = 0.0, patience_ = 0.0;
};

struct Approach {
  std::optional<Motion> motion;  ///< empty if the trajectory did not become steady
  double time = 0.0;             ///< after which it was recognised
};

/// What motion_from() does and answers, and when. Once `stop` is set there is no motion.
Approach settle(const model::System& system, const Eigen::VectorXd& state, double patience, const StopFlag* stop);

}  // namespace equipoise
