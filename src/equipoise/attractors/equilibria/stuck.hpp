// Balls that stiction holds for good: a continuum of states, and how well they are balanced.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// Distance at which the rotor without balls would whirl at `speed` (mean of both supports).
double bare_response(const model::Parameters& p, double speed);

/// The rule that calls balls balanced where no theory does, for dry friction or contact: wherever they are, the rotor
/// whirls at most half as far as without them.
bool halves_the_shaking(const model::Parameters& p, double speed, double r);

/// The rotor's motion once all balls are stuck in their places.
struct StuckEnd {
  Eigen::VectorXd state;                          ///< in the end; on a stroboscopic section where psi = 0
  double r_min = 0.0, r_mean = 0.0, r_max = 0.0;  ///< in the end
  double slowest_rate = 0.0;                      ///< at which the rotor comes there, negative
};

/// Whether all balls rest at `state` and rotor angle `psi`, and will never be torn off. The rest of the rotor's motion
/// decays with a Lyapunov function, which bounds all future forces on the balls. At a prescribed speed (on any
/// supports, with gravity) that is a proof. A motor's equations are not linear, so forces may be twice the linear
/// bound. With a motor and gravity or anisotropic supports, it is decided only if the rotor hangs at rest for good
/// (machine/mechanics/gravity_well.hpp); otherwise empty.
std::optional<StuckEnd> stuck_for_good(const model::System& system, const Eigen::VectorXd& state, double psi);

Motion describe_stuck(const model::System& system, const StuckEnd& end);

}  // namespace equipoise
