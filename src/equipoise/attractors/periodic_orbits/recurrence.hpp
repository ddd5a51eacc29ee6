// When a trajectory returns to where it was, and how far a state is from a periodic orbit.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// The difference of two states in natural sizes: lengths over lambda + sum mu_i, velocities over System::pace() times
/// that; angles (modulo their turns) and rates as they are.
class StateDifference {
 public:
  explicit StateDifference(const model::System& system);

  Eigen::VectorXd operator()(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const { return (*this)(a, b).norm(); }
  /// Length of a rate of change dz/dt.
  double length(const Eigen::VectorXd& rate) const { return rate.cwiseProduct(inverse_size_).norm(); }

 private:
  std::vector<model::System::Angle> angles_;
  Eigen::VectorXd inverse_size_;
};

/// A closest approach of a trajectory to its last state, and how long before it.
struct Return {
  double time = 0.0, distance = 0.0;
};

/// Returns to the last of `samples`, at most `most`, shortest first. Samples are equally spaced in time, or lie on
/// successive stroboscopic sections; angles are unwrapped. Each return is at least twice as close as all shorter ones.
/// It takes at most 24 turns of a ball (or of the rotor, if its angle matters) and, for a flow, 32 times the first
/// return, or `longest_multiple` times. One section later always counts within `reach`: on its way to a motion of that
/// period a trajectory may not be closer.
std::vector<Return> returns_to_last(const model::System& system, const std::vector<Eigen::VectorXd>& samples,
                                    double spacing, const StateDifference& difference, int most, double reach,
                                    double longest_multiple = 32.5);

/// A periodic orbit as a curve, or as its points on a stroboscopic section.
class OrbitCurve {
 public:
  OrbitCurve(const model::System& system, const PeriodicOrbit& orbit);

  /// From `state` to the nearest point of the orbit; true to about 1e-7.
  double distance(const Eigen::VectorXd& state) const;
  /// The least distance of a point of the orbit by another measure, which changes no faster than the point moves; true
  /// to about 1e-7 where it is below `near`.
  double least(const std::function<double(const Eigen::VectorXd&)>& distance_to, double near) const;
  /// Where the motion is after `share` of its period, 0 to 1; true to about 1e-7. On a stroboscopic section the nearest
  /// point.
  Eigen::VectorXd at(double share) const;

 private:
  using DistanceTo = std::function<double(const Eigen::VectorXd&)>;
  std::size_t count() const { return rates_.empty() ? states_.size() : states_.size() - 1; }
  Eigen::VectorXd on_arc(std::size_t arc, double share) const;
  double least_beside(std::size_t sample, const DistanceTo& distance_to) const;

  StateDifference difference_;
  double step_ = 0.0;
  // One more than a period holds, so that the curve closes; points have no rates.
  std::vector<Eigen::VectorXd> states_, rates_;
};

}  // namespace equipoise
