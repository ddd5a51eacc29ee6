// The rotor's prescribed motion: a piecewise linear ramp function Omega(t), the law that turns it into psi(t), and the
// segments on which psi'' is constant and the balls are either clamped or free.
#pragma once

#include <limits>
#include <optional>
#include <vector>

namespace equipoise::model {

/// How psi follows from the ramp function Omega(t).
enum class SpeedLaw {
  kinematic,  ///< psi' = Omega(t): the rotor turns at the stated speed
  published,  ///< psi = t Omega(t) on each branch, as Wright and Peng (2019) have it; psi' then jumps at branch ends
};

/// The ramp function: linear between points, constant after the last.
struct SpeedProfile {
  std::vector<double> times{0.0};   ///< strictly increasing, first 0
  std::vector<double> speeds{0.0};  ///< in units of the critical speed
  SpeedLaw law = SpeedLaw::kinematic;
  double initial_angle = 0.0;  ///< psi(0)

  double ramp_function(double t) const;
  double final_speed() const { return speeds.back(); }
  /// When the last branch begins: from here on the rotor runs at final_speed().
  double settled_time() const { return times.back(); }
  /// When the ramp function first equals `speed`; empty if it never does.
  std::optional<double> first_time_at(double speed) const;
};

/// An interval on which psi(t) = psi + speed tau + acceleration tau^2/2, tau = t - begin.
struct Segment {
  double begin, end;  ///< the last segment ends at infinity
  double psi, speed, acceleration;
  bool clamped;  ///< balls held at their angles

  double psi_at(double t) const { return psi + (speed + 0.5 * acceleration * (t - begin)) * (t - begin); }
  double speed_at(double t) const { return speed + acceleration * (t - begin); }
};

/// Cuts the motion at every discontinuity of psi', psi'' and of the clamp (`release_time`), so that a step that ends
/// with a segment meets each exactly. The last segment is free, at constant speed, without end.
std::vector<Segment> segments(const SpeedProfile& profile, double release_time);

}  // namespace equipoise::model
