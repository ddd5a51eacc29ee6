// When a trajectory comes back to where it was, and how far a state is from a periodic orbit.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "equipoise/model/parameters.hpp"
#include "equipoise/orbits/orbit.hpp"

namespace equipoise {

/// The difference of two states in natural sizes: lengths over lambda + sum mu_i, velocities over Omega times that,
/// angles (modulo whole turns) and ball rates as they are.
class StateDifference {
 public:
  StateDifference(const model::Parameters& p, double speed);

  Eigen::VectorXd operator()(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const { return (*this)(a, b).norm(); }
  /// Length of a rate of change dz/dt.
  double length(const Eigen::VectorXd& rate) const { return rate.cwiseProduct(inverse_size_).norm(); }

 private:
  int balls_;
  Eigen::VectorXd inverse_size_;
};

/// A closest approach of a trajectory to its last state, so long before it.
struct Return {
  double time = 0.0, distance = 0.0;
};

/// Returns to the last of `samples` (equally spaced in time, angles unwrapped), shortest first, each at least twice as
/// close as all shorter ones and none longer than 24 turns of a ball or 32 times the first; `most` at most.
std::vector<Return> returns_to_last(const std::vector<Eigen::VectorXd>& samples, double spacing, int balls,
                                    const StateDifference& difference, int most);

/// A state near a periodic orbit and its period.
struct OrbitGuess {
  Eigen::VectorXd state;
  double period = 0.0;
};

/// Newton's method for the periodic orbit near `state` of about period `time`, by single shooting, undamped: good
/// enough for stable orbits, and it gives up early, within `reach` of the start, where there is none (on a torus a
/// second multiplier is near 1, whatever the time, and steps do not shrink). What it finds is true to about 1e-5.
std::optional<OrbitGuess> shoot(const model::Parameters& p, double speed, const Eigen::VectorXd& state, double time,
                                const StateDifference& difference, double reach);

/// A periodic orbit as a curve.
class OrbitCurve {
 public:
  OrbitCurve(const model::Parameters& p, double speed, const PeriodicOrbit& orbit);

  /// From `state` to the nearest point of the orbit; true to about 1e-7.
  double distance(const Eigen::VectorXd& state) const;

 private:
  StateDifference difference_;
  double step_;
  std::vector<Eigen::VectorXd> states_, rates_;  // one more than a period holds, so that the curve closes
};

}  // namespace equipoise
