// Where the balls cancel the unbalance: existence and angles of the balanced states.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "equipoise/model/parameters.hpp"
#include "equipoise/model/system.hpp"

namespace equipoise::model {

/// Of a motor whose torque acts for good at every speed. What shakes may be held by that; what is balanced may not.
inline constexpr const char* no_speed_is_held =
    "a balanced rotor needs no torque, and the motor's never vanishes: balanced, it would speed up without end";

/// Solutions of lambda + sum mu_i e^{i phi_i} = 0, x = y = 0, all at rest in the rotating frame.
struct BalancedStates {
  enum class Kind {
    none,      ///< the balls cannot cancel the unbalance (`reason` says why)
    isolated,  ///< finitely many; `angles` lists them
    family,    ///< a continuum (three balls or more, or no unbalance at all); balls in contact overlap in a part of it
  };
  Kind kind = Kind::none;
  std::vector<std::array<double, max_balls>> angles;
  std::string reason;
};

/// Exists if and only if 2 max(lambda, mu_1..mu_n) <= lambda + sum mu_i (polygon inequality), balls that collide have
/// room for it (model/cancelling.hpp), and there is no gravity.
BalancedStates balanced_states(const Parameters& p);

/// A member of the family near the ball angles `phi`: Newton's method with the least change of angles. False if it does
/// not converge, in which case `phi` is left somewhere on the way. Whole turns stay, however many.
bool project_to_balanced(const Parameters& p, double* phi);

// The same of any system, as it is without gravity and with the means of unequal supports. Balls that rest balance a
// race off its centre by bringing the race's own centre to the axis of rotation, which leaves the shaft off it by the
// race's offset, and the supports' damper with work to do (docs/equations.md, "An off-centre race").

/// The rotor with a centred race whose balls balance at the same angles less `turn`.
struct CentredTwin {
  Parameters parameters;
  double turn = 0.0;
};
CentredTwin centred_twin(const Parameters& p, double speed);

/// psi' in balance: as prescribed, or where the motor gives what the dampers take. Empty where there is none, and where
/// any will do (System::coasts()).
std::optional<double> balanced_speed(const System& system);
/// At that speed; of systems that have none of their own at `coasting`.
BalancedStates balanced_states(const System& system, double coasting = 0.0);
/// As above, at `speed`.
bool project_to_balanced(const System& system, double speed, double* phi);
/// The balanced state with the balls at these angles, at `speed` and, where that is part of it, psi = 0.
Eigen::VectorXd balanced_state(const System& system, double speed, const double* phi);
/// Of the race's centre from where it is when the balls balance, the rotor resting in its frame.
double off_balance(const Parameters& p, double x, double y);
/// Directions in which a balanced state may be moved without any force: along the continuum of three balls or more, and
/// in speed if nothing holds it. None where gravity acts, or unequal supports on a race off its centre: they leave no
/// state at rest.
int balanced_freedom(const System& system);

}  // namespace equipoise::model
