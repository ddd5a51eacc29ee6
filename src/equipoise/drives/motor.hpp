// The motor of a driven rotor: torque as a function of time and speed, cut into pieces on which it is smooth.
#pragma once

#include <optional>
#include <vector>

#include "equipoise/drives/speed.hpp"

namespace equipoise::model {

/// tau(t, psi') in units of M R^2 omega_c^2. Torque laws of a motor: docs/equations.md, "A motor".
struct MotorLaw {
  enum class Kind {
    linear,   ///< constant + slope psi', and 0 from `until` on
    table,    ///< linear between `times`, constant outside them
    control,  ///< gain e + integral (time integral of e) with e = target(t) - psi', cut to |tau| <= limit
  };
  Kind kind = Kind::linear;
  double constant = 0.0, slope = 0.0;
  std::optional<double> until;
  std::vector<double> times, values;
  double gain = 0.0, integral = 0.0;
  std::optional<double> limit;
  SpeedProfile target;

  /// The speed at which an unloaded rotor ends up: where the torque vanishes for good. Empty if there is none.
  std::optional<double> final_speed() const;
};

/// An interval on which tau = cut(constant + slope psi' + rate (t - begin) + integral E), with E' = target' - psi':
/// dE/dt = aim + aim_rate (t - begin) - psi', but 0 while that would push a cut torque further out.
struct DriveSegment {
  double begin, end;  ///< the last segment ends at infinity
  double constant = 0.0, slope = 0.0, rate = 0.0;
  double integral = 0.0, aim = 0.0, aim_rate = 0.0;
  double limit = std::numeric_limits<double>::infinity();

  double torque(double t, double speed, double error_integral) const;
  /// dE/dt.
  double error_rate(double t, double speed, double error_integral) const;

 private:
  double uncut(double t, double speed, double error_integral) const;
};

/// The pieces of a motor's law, contiguous from 0, the last without end.
std::vector<DriveSegment> drive_segments(const MotorLaw& law);

}  // namespace equipoise::model
