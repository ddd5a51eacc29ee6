// The well in which gravity holds a driven rotor that its motor cannot lift. docs/explanation/equations.md, "A stalled
// rotor".
#pragma once

#include <complex>
#include <optional>

#include <Eigen/Core>

#include "equipoise/machine/model/system.hpp"

namespace equipoise::model {

/// Let tau be the motor's torque at rest. E - tau psi never grows if the torque does not rise with the speed: dampers,
/// drag, friction and impacts only dissipate. A rotor below the lower of the two maxima next to its well never leaves
/// the well and comes to rest in it. This is exact: nothing is linearised or sampled.
class GravityWell {
 public:
  /// For a rotor whose balls run free. Empty if gravity does not hold it, if the motor's torque rises with the speed,
  /// or for a control with an integral, whose torque at rest is not known in advance.
  static std::optional<GravityWell> of(const System& system);

  bool holds(const double* state) const;
  /// Whether, from a state that the well holds, no ball will ever pass above the shaft either.
  bool holds_balls(const double* state) const;
  /// The state at rest with every ball below the shaft: the final state if balls pass each other and do not stick.
  Eigen::VectorXd bottom() const;

 private:
  friend bool trapped_in_well(const System& system, const double* held, double speed);
  GravityWell(const System& system, std::complex<double> moment, double torque, double balls);
  double level(const double* state) const;  // E - tau psi, with psi reduced to the well

  System system_;
  std::complex<double> moment_;  // of gravity on everything that turns with the rotor: Re(moment e^{i psi}) opposes the
                                 // torque
  double torque_;
  double angle_;      // psi + arg(moment) lies within a turn below this; at rest it is minus this
  double top_ = 0.0;  // E - tau psi at the lower maximum
};

/// Whether a rotor with held balls (state: machine/model/held_state.hpp) is in such a well and never again as fast as
/// `speed`.
bool trapped_in_well(const System& system, const double* held, double speed);

}  // namespace equipoise::model
