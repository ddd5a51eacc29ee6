// Rotors that no torque drives any more: whether they have come to balance at the speed that they kept, or lost too
// much of it. docs/numerics.md, "Rotors that coast".
#pragma once

#include <optional>

#include <Eigen/Core>

#include "equipoise/attractors/motion.hpp"
#include "equipoise/base/stop_flag.hpp"
#include "equipoise/mechanics/balanced_state.hpp"
#include "equipoise/model/system.hpp"

namespace equipoise {

/// Such a rotor has nothing but its energy, of which dampers, drag, friction and impacts only take, and no motion but
/// exact balance takes nothing. One that has less than it takes to turn at `stall_speed`, all balls at rest in the
/// race, therefore stalls for good. Balance may keep any speed: a state is asked about balance at its own.
class CoastingRegion {
 public:
  /// `horizon`: how long a speed has to last.
  CoastingRegion(const model::System& system, double stall_speed, double horizon);

  bool stalls(const double* state) const;

  struct Answer {
    bool balanced = false;
    double wait = 0.0;  ///< how long it is not worth asking again
  };
  /// Whether a state comes to balance. Where balance is exact: it is near a balanced state which is stable at the speed
  /// that it has, and is seen to go there at half the rate of the linear theory or faster. Elsewhere its
  /// lasting_motion() must be balanced.
  Answer balances(const double* state, const StopFlag* stop = nullptr) const;

  /// The motion that the rotor comes to if its present speed is held: gravity, an off-centre race and stuck balls leave
  /// balance a small motion, which takes a little of the speed for ever. Empty if it is not stable, or takes so much
  /// that the rotor may stall within the horizon.
  std::optional<Motion> lasting_motion(const Eigen::VectorXd& state, const StopFlag* stop = nullptr) const;

 private:
  /// The same rotor, its speed held, and the state that it has there at angle psi.
  struct Held {
    model::System system;
    Eigen::VectorXd state;
    double psi;
  };
  Held held_at_present_speed(const Eigen::VectorXd& state) const;
  double energy(const double* state) const;
  bool is_near(const double* state) const;
  Answer approaches(const Eigen::VectorXd& state) const;

  model::System system_;
  double horizon_;
  bool balances_, exact_;  // there are balanced states; they are at rest
  double least_energy_;    // of a rotor that may not stall
};

}  // namespace equipoise
