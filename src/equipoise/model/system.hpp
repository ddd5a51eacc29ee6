// What every question is about: a rotor, its supports and balls, and the last piece of what drives it, as one dynamical
// system.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/model/machine.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// Where the states of a motion are taken before they are compared.
enum class Section {
  none,    ///< nothing depends on the rotor's angle: anywhere
  strobe,  ///< gravity or unequal supports at a prescribed speed: whenever the rotor has turned by strobe_angle()
  turn,    ///< the same with a motor: anywhere, but the rotor's angle, modulo strobe_angle(), is part of the state
};

/// What interrupts an otherwise smooth motion.
struct Events {
  bool contact = false;  ///< balls collide
  bool stick = false;    ///< balls come to rest, and leave it, by dry friction
  bool any() const { return contact || stick; }
};

/// Where the rotor's angle psi, its speed psi' and the integral of a speed error stand in a state; -1: nowhere.
struct DrivePlaces {
  int psi = -1, speed = -1, error = -1;
};

/// Size of each component of the state of parameters.hpp that counts as one when components of different units are
/// compared: lambda + sum mu_i (what r is of the order of) for the rotor's, 1 for the balls'.
Eigen::VectorXd state_scale(const Parameters& p);

/// Nothing that a rotor meets holds it any more when it turns thirty times as fast as it resonates.
inline constexpr double out_of_reach = 30.0;

/// The state is that of parameters.hpp, then, of a driven rotor and in the order of machine.hpp: psi on section turn,
/// psi', and the integral of the speed error if the motor's control has one.
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
  /// A prescribed speed, and the race centred: FreeFlow (flow-inl.hpp) is all its equations.
  bool plain() const { return prescribed() && p_.race_is_centred(); }
  /// Plain and smooth: nothing happens but at the corners of its drive.
  bool simple() const { return plain() && smooth(); }

  int dimension() const { return dimension_; }
  /// Places in the state, -1 for what is no part of it.
  int psi_place() const { return section_ == Section::turn ? model::dimension(p_.balls) : -1; }
  int speed_place() const { return prescribed() ? -1 : model::dimension(p_.balls) + (psi_place() < 0 ? 0 : 1); }
  int error_place() const { return has_error_integral() ? dimension_ - 1 : -1; }
  DrivePlaces places() const { return {psi_place(), speed_place(), error_place()}; }

  /// The prescribed psi', not 0 where states are strobed; of a driven rotor that of a state.
  double speed() const { return drive_.speed; }
  double speed(const Eigen::VectorXd& y) const { return prescribed() ? drive_.speed : y[speed_place()]; }
  /// The speed that steps in time and rates of change are measured by: the prescribed psi'; of a driven rotor that at
  /// which its motor gives no torque, 0 if there is none.
  double pace() const { return prescribed() ? drive_.speed : no_load_speed().value_or(0.0); }

  // Of motors.
  /// Where the torque vanishes; empty if nowhere or everywhere.
  std::optional<double> no_load_speed() const;
  /// No torque acts for good: what is balanced keeps any speed.
  bool coasts() const;
  /// Nothing holds a rotor that turns as fast as that, far above all resonances: its motor's torque does not fall as
  /// the rotor turns faster.
  bool runs_away(double speed) const;
  /// Of a state.
  double torque(const Eigen::VectorXd& y) const;

  /// Section strobe: the rotor turns by this, in this time, before the equations are what they were.
  double strobe_angle() const;
  double strobe_period() const;

  /// A component that is an angle, and the turn after which it is what it was. The balls' come first.
  struct Angle {
    int place;
    double turn;
  };
  std::vector<Angle> angles() const;
  /// The same state with its angles in [0, turn).
  Eigen::VectorXd with_angles_reduced(Eigen::VectorXd y) const;
  /// state_scale(), and 1 for all others.
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
