// The dynamical system that every question is about: rotor, supports, balls and the last piece of the drive. All rooms
// above `model` ask it for its state and section; what an answer needs of it is in capability.hpp.
// This room: parameters, equations of motion, the system, the layout of its state.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/machine/drives/full_state.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/machine/model/state_layout.hpp"

namespace equipoise::model {

/// Where the states of a motion are taken for comparison.
enum class Section {
  none,          ///< nothing depends on the rotor's angle: anywhere
  stroboscopic,  ///< gravity or unequal supports at a prescribed speed: whenever the rotor has turned by
                 ///< section_angle()
  turn,  ///< the same with a motor: anywhere, but the rotor's angle, modulo section_angle(), is part of the state
};

/// Events that interrupt an otherwise smooth motion.
struct Events {
  bool contact = false;  ///< balls collide
  bool stick = false;    ///< dry friction stops balls and lets them go
  bool any() const { return contact || stick; }
};

/// Size of each component of the state of parameters.hpp that counts as one when components of different units are
/// compared: lambda + sum mu_i (what r is of the order of) for the rotor's, 1 for the balls'.
Eigen::VectorXd state_scale(const Parameters& p);

/// Speed, in critical speeds, above which no resonance can hold a rotor.
inline constexpr double out_of_reach = 30.0;

/// The state is layout()'s. For a driven rotor psi', on section turn psi, and where the motor's control integrates the
/// speed error that integral, are part of it.
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
  /// A prescribed speed, a centred race and no tilt: FreeFlow (flow-inl.hpp) has all the equations.
  bool plain() const { return prescribed() && p_.race_is_centred() && !tilts(); }
  bool tilts() const { return p_.tilts(); }
  /// Plain and smooth: no events but the corners of the drive.
  bool simple() const { return plain() && smooth(); }

  const StateLayout& layout() const { return layout_; }
  int dimension() const { return layout_.size; }

  /// The prescribed psi' (not 0 with a stroboscopic section), or that of state `y` if the rotor is driven.
  double speed() const { return drive_.speed; }
  double speed(const Eigen::VectorXd& y) const { return prescribed() ? drive_.speed : y[layout_.speed]; }
  /// The speed that steps in time and rates of change are measured by: the prescribed psi'; of a driven rotor that at
  /// which its motor gives no torque, 0 if there is none.
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

  /// Stroboscopic section: period of the equations, as an angle of the rotor and as a time.
  double section_angle() const;
  double section_period() const;

  /// A component that is an angle, and its period. The balls' come first.
  struct Angle {
    int place;
    double turn;
  };
  std::vector<Angle> angles() const;
  /// The same state with its angles in [0, turn).
  Eigen::VectorXd with_angles_reduced(Eigen::VectorXd y) const;
  /// state_scale(), then 1 for the drive's components, and for a tilt what state_scale() has for the centre.
  Eigen::VectorXd scale() const;

  /// Exchanging these two balls makes no difference.
  bool alike(int i, int k) const { return p_.alike(i, k); }

 private:
  Parameters p_;
  DrivePiece drive_;
  Section section_;
  StateLayout layout_;
};

}  // namespace equipoise::model
