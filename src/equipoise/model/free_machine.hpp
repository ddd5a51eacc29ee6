// A machine in the last piece of its drive, its balls free: what it does from then on as one small system of ordinary
// differential equations and its linearisation. Without contact and dry friction, which are not smooth.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/model/machine.hpp"
#include "equipoise/model/parameters.hpp"
#include "equipoise/model/system.hpp"

namespace equipoise::model {

/// Its state: that of parameters.hpp; of a driven rotor psi' too, and the integral of the speed error if its control
/// has one. The rotor's angle is no part of it: equations that depend on it are asked at an angle.
class FreeMachine {
 public:
  FreeMachine(const Parameters& p, const DrivePiece& last);

  int size() const { return static_cast<int>(kept_.size()); }
  bool driven() const { return !system_.prescribed(); }
  const System& system() const { return system_; }
  /// The place of psi' in the state; -1 if it is prescribed.
  int speed_place() const { return driven() ? dimension(parameters().balls) : -1; }
  const Parameters& parameters() const { return system_.parameters(); }

  /// From the state of machine.hpp.
  Eigen::VectorXd reduced(const double* z) const;
  double speed(const Eigen::VectorXd& y) const;

  Eigen::VectorXd rate(const Eigen::VectorXd& y, double psi = 0.0) const;
  /// Exact, by dual numbers.
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& y, double psi = 0.0) const;

  /// What a balanced rotor's speed comes to: where the torque vanishes, or as prescribed. None if it never vanishes
  /// (the rotor speeds up for ever) or always does (coasts()).
  std::optional<double> balanced_speed() const;
  /// No torque acts for good: a balanced rotor keeps any speed.
  bool coasts() const { return system_.coasts(); }
  /// The motor's torque falls as the rotor turns faster, so that no speed runs away.
  bool holds_speed() const;
  /// The balanced state at ball angles `phi`, turning at `speed`.
  Eigen::VectorXd balanced_state(const double* phi, double speed) const;

 private:
  const DrivePiece& drive() const { return system_.drive(); }
  Eigen::VectorXd at_angle(const Eigen::VectorXd& y, double psi) const;

  System system_;
  std::vector<int> kept_;  // places in the system's state, psi left out
};

}  // namespace equipoise::model
