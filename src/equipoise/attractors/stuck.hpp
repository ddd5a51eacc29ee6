// Balls that stiction holds for good: a continuum of states, and how well they are balanced.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/attractors/motion.hpp"
#include "equipoise/model/system.hpp"

namespace equipoise {

/// Distance at which the rotor without balls would whirl at `speed` (mean of both supports).
double bare_response(const model::Parameters& p, double speed);

/// The rule by which balls that dry friction holds, or that touch, are called balanced where no theory does: they leave
/// at most half the whirl that the rotor would have without them, wherever they are.
bool halves_the_shaking(const model::Parameters& p, double speed, double r);

/// What the rotor does once all its balls are stuck where they are.
struct StuckEnd {
  Eigen::VectorXd state;                          ///< in the end; on section strobe where psi = 0
  double r_min = 0.0, r_mean = 0.0, r_max = 0.0;  ///< in the end
  double slowest_rate = 0.0;                      ///< at which the rotor comes there, negative
};

/// Whether all balls rest at `state`, the rotor's angle being `psi`, and will never be torn off: what is still to come
/// of the rotor's motion decays with a Lyapunov function, which bounds the forces on the balls from now on. At a
/// prescribed speed (on any supports, with gravity) that is a proof; under a motor, whose equations are not linear,
/// forces may be twice what the linear ones bound; with gravity or unequal supports only where it hangs at rest for
/// good (mechanics/gravity_well.hpp), else that is not decided (empty).
std::optional<StuckEnd> stuck_for_good(const model::System& system, const Eigen::VectorXd& state, double psi);

/// Described.
Motion describe_stuck(const model::System& system, const StuckEnd& end);

}  // namespace equipoise
