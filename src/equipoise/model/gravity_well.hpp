// The well in which gravity holds a driven rotor that its motor cannot lift. docs/equations.md, "A stalled rotor".
#pragma once

#include <complex>
#include <optional>

#include <Eigen/Core>

#include "equipoise/model/system.hpp"

namespace equipoise::model {

/// E - tau psi, tau the motor's torque at rest, never grows if the torque falls as the speed grows: dampers, drag,
/// friction and impacts only take. A rotor that has less of it than the lower of the two tops beside its well never
/// leaves that again, and comes to rest there. Nothing of this is linear or tried.
class GravityWell {
 public:
  /// Of a rotor whose balls run free. Empty where gravity does not hold it, where the motor's torque rises with the
  /// speed, and for a control with an integral, whose torque at rest is not known beforehand.
  static std::optional<GravityWell> of(const System& system);

  bool holds(const double* state) const;
  /// Nor will any ball ever pass above the shaft, of a state that it holds.
  bool holds_balls(const double* state) const;
  /// At rest, every ball below the shaft: where all ends if the balls can pass each other and nothing makes them stick.
  Eigen::VectorXd bottom() const;

 private:
  friend bool held_in_well(const System& system, const double* held, double speed);
  GravityWell(const System& system, std::complex<double> moment, double torque, double balls);
  double level(const double* state) const;  // E - tau psi, psi taken into the well

  System system_;
  std::complex<double> moment_;  // gravity's on what turns with the rotor: Re(moment e^{i psi}), against the torque
  double torque_;
  double angle_;      // psi + arg(moment) is less than this, by a turn at most; minus this where the rotor rests
  double top_ = 0.0;  // E - tau psi there
};

/// The same of a rotor with its balls held, in a state of model/held_state.hpp: it is in such a well, and will never
/// again be as fast as `speed`.
bool held_in_well(const System& system, const double* held, double speed);

}  // namespace equipoise::model
