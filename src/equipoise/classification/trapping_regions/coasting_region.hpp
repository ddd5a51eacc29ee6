// Rotors that no torque drives any more: whether they have become balanced at their remaining speed, or have lost too
// much of it. See docs/explanation/numerics.md, "Coasting rotors".
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// A coasting rotor has only its energy. Dampers, drag, friction and impacts take from it, and only exact balance loses
/// nothing. A rotor with less energy than it takes to turn at `stall_speed`, with all balls at rest in the race,
/// therefore stalls for good. Balance may keep any speed, so a state is tested at its own.
class CoastingRegion {
 public:
  /// `horizon`: how long a speed must last.
  CoastingRegion(const model::System& system, double stall_speed, double horizon);

  bool stalls(const double* state) const;

  /// Whether a state becomes balanced (balanced_id). Where balance is exact, the state must be near a balanced state
  /// that is stable at its speed, and be seen to approach it at half the linear rate or faster. Elsewhere its
  /// lasting_motion() must be balanced.
  Caught balances(const double* state, const StopFlag* stop = nullptr) const;

  /// The motion that the rotor comes to if its speed is prescribed. Gravity, an off-centre race and stuck balls leave a
  /// small motion in balance, which keeps taking a little of the speed. Empty if the motion is unstable, or takes so
  /// much that the rotor may stall within the horizon.
  std::optional<Motion> lasting_motion(const Eigen::VectorXd& state, const StopFlag* stop = nullptr) const;

 private:
  /// The same rotor at a prescribed speed, and its state there at angle psi.
  struct AtSpeed {
    model::System system;
    Eigen::VectorXd state;
    double psi;
  };
  AtSpeed at_present_speed(const Eigen::VectorXd& state) const;
  double energy(const double* state) const;
  bool is_near(const double* state) const;
  Caught approaches(const Eigen::VectorXd& state) const;

  model::System system_;
  double horizon_;
  bool balances_, exact_;  // balanced states exist; they are at rest
  double least_energy_;    // of a rotor that must not stall
};

}  // namespace equipoise
