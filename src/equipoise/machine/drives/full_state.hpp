// What moves a rotor, piece by piece of time, and when it lets go of its balls.
#pragma once

#include <optional>
#include <vector>

#include "equipoise/machine/drives/motor.hpp"
#include "equipoise/machine/drives/speed.hpp"

namespace equipoise::model {

/// What drives the rotor on one piece of time.
struct DrivePiece {
  double begin = 0.0, end = 0.0;
  bool prescribed = true;
  double psi = 0.0, speed = 0.0, acceleration = 0.0;  ///< if prescribed: psi, psi' at `begin`, and psi''
  SpeedCurve curve{};                                 ///< if prescribed: as in Segment
  DriveSegment motor{};                               ///< if not

  bool driven() const { return !prescribed; }
  /// If prescribed.
  Segment motion(bool clamped) const { return {begin, end, psi, speed, acceleration, clamped, curve}; }
};

/// How a rotor is brought to speed and when it lets go of its balls.
struct Drive {
  std::vector<DrivePiece> pieces;       ///< contiguous from t = 0, the last without end
  double psi = 0.0, speed = 0.0;        ///< at t = 0
  double release_time = 0.0;            ///< balls are held until then; infinite if `release_speed` decides
  std::optional<double> release_speed;  ///< driven rotor: balls are released when psi' first equals this
};

/// A rotor that turns as prescribed.
Drive prescribed_drive(const std::vector<Segment>& segments);
/// A rotor driven by a motor.
Drive motor_drive(const MotorLaw& law, double psi, double speed);

}  // namespace equipoise::model
