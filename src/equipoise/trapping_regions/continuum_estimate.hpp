// What the trapping region of a continuum says, for a thousandth of the work.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/model/system.hpp"
#include "equipoise/periodic_orbits/continuum_of_equilibria.hpp"

namespace equipoise {

/// Members whose matrices stand for those beside them.
class ContinuumEstimate {
 public:
  ContinuumEstimate(const model::System& system, std::vector<ContinuumMember> members);

  /// V of a state over the level that `factor` gives the member which it comes to. Empty if it is not known: no member
  /// is within 0.6 rad, in each ball's angle, of the balance that is nearest to it.
  std::optional<double> depth(const Eigen::VectorXd& state, double factor) const {
    return depth_without(members_.size(), state, factor);
  }

  /// What is wrong with depths, by each member and states around it as the others see them.
  struct Errors {
    double shortfall = 0.0;  ///< the largest factor by which they are too small; 0 if members are too far apart to tell
    double excess = 0.0;     ///< the largest by which they are too great
    double floor = 0.0;      ///< the largest that is left of them on the continuum itself
  };
  Errors errors(const ContinuumOfEquilibria& continuum, double factor) const;

 private:
  // As if a member was not there.
  std::optional<double> depth_without(std::size_t left_out, const Eigen::VectorXd& state, double factor) const;

  // Of the balanced state at some ball angles; a state's offset from it with balls named as those of that member.
  struct Nearest {
    std::size_t member = 0;
    double distance = 0.0;
    Eigen::VectorXd offset;
  };
  // The balls as they follow each other round the race, if they are alike; else as they are numbered.
  struct Ring {
    std::array<int, model::max_balls> ball{};
    std::array<double, model::max_balls> angle{};  // 0 to 2 pi
  };
  Ring ring(const double* angles) const;
  Nearest nearest(std::size_t left_out, const double* balanced, const Eigen::VectorXd& offset) const;

  model::System system_;
  bool interchangeable_;
  double speed_;
  Eigen::VectorXd scale_;
  std::vector<ContinuumMember> members_;
  std::vector<Ring> rings_;
  std::vector<Eigen::VectorXd> moved_;  // the members' centres from the balanced states at their angles
};

}  // namespace equipoise
