// Balanced states, in which the balls cancel the unbalance: existence and angles.
// This room: which unbalances the balls can cancel, and where they then are.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise::model {

/// Solutions of lambda + sum mu_i e^{i phi_i} = 0, x = y = 0, all at rest in the rotating frame.
struct BalancedStates {
  enum class Kind {
    none,       ///< the balls cannot cancel the unbalance (`reason` says why)
    isolated,   ///< finitely many; `angles` lists them
    continuum,  ///< three balls or more, or no unbalance at all; balls in contact overlap in part of it
  };
  Kind kind = Kind::none;
  std::vector<std::array<double, max_balls>> angles;
  std::string reason;
};

/// Of a tilting rotor: tilt_balanced_states(). Else it exists if and only if 2 max(lambda, mu_1..mu_n) <= lambda +
/// sum mu_i (polygon inequality), balls that collide have room for it (machine/balance/cancelling.hpp), and there is no
/// gravity.
BalancedStates balanced_states(const Parameters& p);

/// Projects the ball angles `phi` onto a nearby member of the continuum: Newton's method with the least change of
/// angles. Keeps whole turns, however many. False if it does not converge; `phi` is then left on the way.
bool project_to_balanced(const Parameters& p, double* phi);

// The same for any system, ignoring gravity and averaging unequal supports. With an off-centre race, balls at rest
// bring the race's centre to the axis of rotation. The shaft then circles at the race's offset, and the supports'
// dampers dissipate (docs/explanation/equations.md, "An off-centre race").

/// The rotor with a centred race whose balls balance at the same angles less `turn`.
struct CentredTwin {
  Parameters parameters;
  double turn = 0.0;
};
CentredTwin centred_twin(const Parameters& p, double speed);

/// psi' in balance: the prescribed speed, or the speed at which the motor supplies what the dampers absorb. Empty if
/// there is none, or if any speed will do (System::coasts()).
std::optional<double> balanced_speed(const System& system);
/// Balanced states at that speed, or at `coasting` if the system coasts.
BalancedStates balanced_states(const System& system, double coasting = 0.0);
/// As for Parameters, at `speed`.
bool project_to_balanced(const System& system, double speed, double* phi);
/// The balanced state with these ball angles at `speed`; psi, if in the state, is 0.
Eigen::VectorXd balanced_state(const System& system, double speed, const double* phi);
/// Of a system's state: distance from the axis of rotation of the race's centre, which lies on it in balance. Of a
/// tilting rotor, with the slope of its shaft as a further distance.
double off_balance(const Parameters& p, const Eigen::VectorXd& state);
/// Dimension of a continuum of balanced states: how many angles are free.
int cancelling_freedom(const Parameters& p);
/// Number of directions in which a balanced state can be moved without force: along the continuum, and in speed if the
/// rotor coasts. 0 with gravity, or with an off-centre race on unequal supports: no state is then at rest.
int balanced_freedom(const System& system);

/// The speed that a motor sustains: balanced_speed() if it does. Empty at a prescribed speed, for a coasting rotor, and
/// for a motor whose last torque speeds the rotor up for ever.
inline std::optional<double> sustained_speed(const System& system) {
  if (system.prescribed() || system.coasts()) return std::nullopt;
  const DriveSegment& m = system.drive().motor;
  const std::optional<double> speed = balanced_speed(system);
  const bool holds = m.integral != 0.0 || !m.is_linear() || m.slope < 0.0 || (speed && *speed * m.constant > 0.0);
  return holds ? speed : std::nullopt;
}

/// Message about a motor that holds no speed, to follow "the" or "the motor's".
inline constexpr const char* holds_no_speed =
    "last torque never ends, and a balanced rotor needs none: no speed is held";

/// Whether the motor's last torque acts for good and holds no speed: a balanced rotor then speeds up without end.
inline bool speeds_up_for_ever(const System& system) {
  return !system.prescribed() && !system.coasts() && !sustained_speed(system);
}

}  // namespace equipoise::model
