// The dynamical system that every question is about: rotor, supports, balls and the last piece of the drive. All rooms
// above `model` ask it for its state and section; what an answer needs of it stands in capability.hpp.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/model/machine.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// Where the states of a motion are taken for comparison.
enum class Section {
  none,    ///< nothing depends on the rotor's angle: anywhere
  strobe,  ///< gravity or unequal supports at a prescribed speed: whenever the rotor has turned by strobe_angle()
  turn,    ///< the same with a motor: anywhere, but the rotor's angle, modulo strobe_angle(), is part of the state
};

/// Events that interrupt an otherwise smooth motion.
struct Events {
  bool contact = false;  ///< balls collide
  bool stick = false;    ///< dry friction stops balls and lets them go
  bool any() const { return contact || stick; }
};

/// Indices in a state of psi, psi' and the integral of the speed error; -1 if the state does not hold it.
struct DrivePlaces {
  int psi = -1, speed = -1, error = -1;
};

/// Unit of each component of the state of parameters.hpp for comparing components: lambda + sum mu_i, the order of
/// magnitude of r, for the rotor's; 1 for the balls'.
Eigen::VectorXd state_scale(const Parameters& p);

/// Speed, in critical speeds, above which no resonance can hold a rotor.
inline constexpr double out_of_reach = 30.0;

/// The state is that of parameters.hpp. A driven rotor's goes on, in the order of machine.hpp, with psi (on section
/// turn), psi' and the integral of the speed error (if the control has one).
class System {
 public:
  /// At a prescribed constant speed, psi = 0 at time 0.
  System(const Parameters& p, double speed);
  /// In the last piece of its drive: a constant speed or a motor whose law no longer depends on time.
  System(const Parameters& p, const DrivePiece& last);

  const Parameters& parameters() const { return p_; }
  const DrivePiece& drive() const { return drive_; }
  int balls() const { return p_.balls; }

  bool prescribed() const { return drive_.prescribed; }
  Section section() const { return section_; }
  /// Nothing depends on the rotor's angle.
  bool autonomous() const { return section_ == Section::none; }
  Events events() const { return {p_.balls_collide(), p_.balls_stick()}; }
  bool smooth() const { return !events().any(); }
  /// A prescribed speed and a centred race: FreeFlow (flow-inl.hpp) has all the equations.
  bool plain() const { return prescribed() && p_.race_is_centred(); }
  /// Plain and smooth: no events but the corners of the drive.
  bool simple() const { return plain() && smooth(); }

  int dimension() const { return dimension_; }
  /// Indices in the state; -1 if it does not hold the variable.
  int psi_place() const { return section_ == Section::turn ? model::dimension(p_.balls) : -1; }
  int speed_place() const { return prescribed() ? -1 : model::dimension(p_.balls) + (psi_place() < 0 ? 0 : 1); }
  int error_place() const { return has_error_integral() ? dimension_ - 1 : -1; }
  DrivePlaces places() const { return {psi_place(), speed_place(), error_place()}; }

  /// The prescribed psi' (not 0 on section strobe), or that of state `y` if the rotor is driven.
  double speed() const { return drive_.speed; }
  double speed(const Eigen::VectorXd& y) const { return prescribed() ? drive_.speed : y[speed_place()]; }
  /// Reference speed for time steps and rates of change: the prescribed psi', or the motor's no-load speed, 0 if it has
  /// none.
  double pace() const { return prescribed() ? drive_.speed : no_load_speed().value_or(0.0); }

  // Of motors.
  /// Where the torque vanishes; empty if nowhere or everywhere.
  std::optional<double> no_load_speed() const;
  /// No torque acts in the end: a balanced rotor keeps any speed.
  bool coasts() const;
  /// Nothing holds a rotor at this speed: it is far above all resonances, and the motor's torque does not fall as the
  /// speed grows.
  bool runs_away(double speed) const;
  /// The motor's torque in a state.
  double torque(const Eigen::VectorXd& y) const;

  /// Section strobe: period of the equations, as an angle of the rotor and as a time.
  double strobe_angle() const;
  double strobe_period() const;

  /// A component that is an angle, and its period. The balls' come first.
  struct Angle {
    int place;
    double turn;
  };
  std::vector<Angle> angles() const;
  /// The same state with its angles in [0, turn).
  Eigen::VectorXd with_angles_reduced(Eigen::VectorXd y) const;
  /// state_scale(), then 1 for the drive's components.
  Eigen::VectorXd scale() const;

  /// Exchanging these two balls makes no difference.
  bool alike(int i, int k) const { return p_.alike(i, k); }

 private:
  bool has_error_integral() const { return !prescribed() && drive_.motor.integral != 0.0; }

  Parameters p_;
  DrivePiece drive_;
  Section section_;
  int dimension_;
};

}  // namespace equipoise::model
