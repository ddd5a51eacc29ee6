// How a trajectory comes to its motion: what motion_from() knows besides the motion.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/types/status.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/motions/motion.hpp"
#include "equipoise/orbits/recurrence.hpp"

namespace equipoise {

/// A stable periodic orbit of the system at hand, ready to be recognised.
struct KnownOrbit {
  PeriodicOrbit orbit;
  std::shared_ptr<const OrbitCurve> curve;
  std::shared_ptr<const Motion> motion;  ///< its description, if there is one already
};

KnownOrbit known_orbit(const model::System& system, const PeriodicOrbit& orbit);
KnownOrbit known_orbit(const model::System& system, const Motion& motion);

/// Is a trajectory steady? is first asked after about this time, the longest a quick attractor takes to pull a start in.
inline constexpr double first_stretch = 100.0;

/// The stretches in which a trajectory is followed until it is steady, each as long as all before: as many as a time of
/// patience has room for, on section strobe in whole strobes.
class Stretches {
 public:
  Stretches(const model::System& system, double patience);

  bool strobed() const { return strobe_ > 0.0; }
  /// Between strobes; 0: there are none.
  double strobe() const { return strobe_; }
  /// About that time, at least one strobe.
  double whole(double time) const;
  double first() const { return first_; }
  /// That of all stretches together.
  double patience() const { return patience_; }
  bool are_over(double elapsed) const { return elapsed >= patience_ * (1.0 - 1e-9); }

 private:
  double strobe_, first_ = 0.0, patience_ = 0.0;
};

struct Settling {
  std::optional<Motion> motion;                        ///< empty if the trajectory did not become steady
  IntegrationStatus status = IntegrationStatus::done;  ///< else the trajectory was lost
  double time = 0.0;                                   ///< after which the motion was recognised, or all that was
                                                       ///< followed
  double speed = 0.0;                                  ///< of the rotor, without a motion, when it was last seen
  bool known = false;                                  ///< the motion is one of those that were known
};

/// What motion_from() does and answers, with more detail. `known`: orbits of this very system; a trajectory that
/// approaches one of them is not searched for others. The same tests decide in both cases. Once `stop` is set there is
/// no motion, and nothing else said is worth anything.
Settling settle(const model::System& system, const Eigen::VectorXd& state, double patience,
                const std::vector<KnownOrbit>& known = {}, const StopFlag* stop = nullptr);

}  // namespace equipoise
