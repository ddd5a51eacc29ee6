// How a trajectory comes to its motion: what motion_from() knows besides the motion.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// The first test whether a trajectory is steady comes after about this time, the longest that a quick attractor takes
/// to pull a start in.
inline constexpr double first_stretch = 100.0;

/// Trajectories are followed at a tolerance that keeps r true to 1e-8.
inline constexpr double follow_tolerance = 1e-9;
/// Returns are looked for in the last part of a stretch: longer than any period met (pair drift, under 300).
inline constexpr double longest_memory = 1200.0;
inline constexpr int most_returns = 6;
/// A trajectory this close to a stable motion, in natural sizes, and still approaching has reached it.
inline constexpr double reached = 1e-3;
/// Farther than this from a stable motion nothing is concluded yet.
inline constexpr double in_reach = 0.5;

/// The stretches in which a trajectory is followed until it is steady, each as long as all before it: as many as
/// patience has room for. On a stroboscopic section they are whole periods of the section.
class Stretches {
 public:
  Stretches(const model::System& system, double patience);

  bool on_section() const { return section_period_ > 0.0; }
  /// Period of the stroboscopic section; 0: there is none.
  double section_period() const { return section_period_; }
  /// About that time, at least one period of the section.
  double whole(double time) const;
  double first() const { return first_; }
  /// The time of all stretches together.
  double patience() const { return patience_; }
  bool are_over(double elapsed) const { return elapsed >= patience_ * (1.0 - 1e-9); }

 private:
  double section_period_, first_ = 0.0, patience_ = 0.0;
};

struct Approach {
  std::optional<Motion> motion;  ///< empty if the trajectory did not become steady
  double time = 0.0;             ///< when it was recognised
};

/// Does what motion_from() does, and also says when. Once `stop` is set there is no motion.
Approach settle(const model::System& system, const Eigen::VectorXd& state, double patience, const StopFlag* stop);

}  // namespace equipoise
