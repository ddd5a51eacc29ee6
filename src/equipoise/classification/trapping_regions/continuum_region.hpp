// The trapping region around a continuum of balanced states, whose level trials set, and estimates of what it answers
// for a thousandth of the work.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/equilibria/continuum_of_equilibria.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// Members whose matrices stand for those of their neighbours.
class ContinuumEstimate {
 public:
  ContinuumEstimate(const model::System& system, std::vector<ContinuumMember> members);

  /// V of a state over the level that `factor` gives its member. Empty if unknown: no member is within 0.6 rad, in each
  /// ball's angle, of the balanced state nearest to it.
  std::optional<double> depth(const Eigen::VectorXd& state, double factor) const {
    return depth_without(members_.size(), state, factor);
  }

  /// Errors of depths, from each member and the states around it as the other members see them.
  struct Errors {
    double shortfall = 0.0;  ///< largest factor by which depths are too small; 0 if members are too far apart to know
    double excess = 0.0;     ///< largest factor by which they are too great
    double floor = 0.0;      ///< largest depth on the continuum itself
  };
  Errors errors(const ContinuumOfEquilibria& continuum, double factor) const;

 private:
  // As if this member did not exist.
  std::optional<double> depth_without(std::size_t left_out, const Eigen::VectorXd& state, double factor) const;

  // The member nearest to the balanced state at some ball angles, and a state's offset from that balanced state, with
  // the member's order of balls.
  struct Nearest {
    std::size_t member = 0;
    double distance = 0.0;
    Eigen::VectorXd offset;
  };
  // Alike balls in their order round the race; others in numerical order.
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
  std::vector<Eigen::VectorXd> moved_;  // from balanced states at the members' angles to the members' centres
};

/// How far a state is at least from all members of a continuum that rest, for next to no work.
class OffContinuum {
 public:
  explicit OffContinuum(const model::System& system);

  /// A lower bound on the deviation from every member (ContinuumOfEquilibria), in System::scale(): all coordinates but
  /// the balls' angles are the same for all members, and angles that differ little leave little unbalance. 0 if members
  /// do not rest.
  double least(const Eigen::VectorXd& state) const;

 private:
  model::System system_;
  bool rests_;
  double speed_, angle_of_unbalance_;
  Eigen::VectorXd scale_;
};

/// Level sets around all attracting members, at a level found by trials of those that attract fast enough
/// (classification/trapping_regions/trials.hpp).
struct ContinuumRegion {
  std::shared_ptr<const ContinuumOfEquilibria> continuum;
  double factor = 0.0;                              ///< times every member's unit of V
  double slowest_rate = 0.0;                        ///< of the members tried (negative)
  Eigen::Vector4d place = Eigen::Vector4d::Zero();  ///< centre of members' x, y, u, v (on a section)
  double reach = 0.0;  ///< bound inside on x, y, u, v from `place`, and on velocities and unbalance from balance
  /// Estimates V from members tried beforehand, because V itself takes an analysis of the state's member. Null if it
  /// cannot separate inside from outside.
  std::shared_ptr<const ContinuumEstimate> estimate;
  double deep = 0.0;  ///< below this share of its level by the estimate, a state is inside
  double far = 0.0;   ///< above it, a state counts as outside; between them V is computed

  /// In place of `factor` for attracting members slower than those tried, if they rest; 0: they catch nothing.
  double slow_factor = 0.0;

  /// Refuses most states that are outside: those further off than V allows. Null: none is refused.
  std::shared_ptr<const OffContinuum> off = nullptr;

  /// Whether a state (on a section if there is one) is inside. For a trajectory with a rotor of its own, around the
  /// members of that rotor's continuum.
  bool holds(const Eigen::VectorXd& state, const OwnRotor* own = nullptr) const;
};

/// Level sets around the attracting members of a continuum. All of 1024 trial states on twice their levels, spread over
/// the members, came near the continuum and were about to end in an attracting member; balls in contact may have
/// touched on the way. 256 trials if the rotor's angle matters. Slower members that rest have a hundredth of that
/// level. Empty if no level passes.
std::optional<ContinuumRegion> continuum_region(const std::shared_ptr<const ContinuumOfEquilibria>& continuum,
                                                const ContinuumSample& sample, const TrialSettings& settings);

}  // namespace equipoise
