// The rotor's prescribed motion: a ramp function Omega(t), the law that turns it into psi(t), and the segments on which
// psi'' is a polynomial, mostly a constant, and the balls are either clamped or free.
// This room: how the rotor turns: ramp functions, motors.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

namespace equipoise::model {

/// How psi follows from the ramp function Omega(t).
enum class SpeedLaw {
  kinematic,  ///< psi' = Omega(t): the rotor turns at the stated speed
  published,  ///< psi = t Omega(t) on each branch, as Wright and Peng (2019) have it; psi' then jumps at branch ends
};

/// A run-up Omega(t) = Omega_max t^n/(t_half^n + t^n).
struct HillFunction {
  double limit = 0.0;      ///< Omega_max, in units of the critical speed
  double half_time = 1.0;  ///< t_half, > 0
  double exponent = 1.0;   ///< n >= 1

  double speed(double t) const;
  double slope(double t) const;
  double steepest() const;  ///< largest |slope|
};

/// The ramp function: linear between points, constant after the last.
struct SpeedProfile {
  std::vector<double> times{0.0};   ///< strictly increasing, first 0
  std::vector<double> speeds{0.0};  ///< in units of the critical speed
  SpeedLaw law = SpeedLaw::kinematic;
  double initial_angle = 0.0;          ///< psi(0)
  std::optional<HillFunction> hill{};  ///< what the speed follows up to times[1], instead of a line; kinematic law

  double ramp_function(double t) const;
  double final_speed() const { return speeds.back(); }
  /// When the last branch begins: from here on the rotor runs at final_speed().
  double settled_time() const { return times.back(); }
  /// When the ramp function first equals `speed`; empty if it never does.
  std::optional<double> first_time_at(double speed) const;
};

/// What bends the speed over a piece of time, sum of by[k] u^(k + 1) with u = rate tau, in addition to its line from
/// end to end.
struct SpeedCurve {
  static constexpr int terms = 15;

  double rate = 0.0;  ///< one over the length of the piece; 0: the line is all
  std::array<double, terms> by{};

  bool present() const { return rate != 0.0; }
  double speed(double tau) const;
  double acceleration(double tau) const;
  double angle(double tau) const;  ///< the integral of speed()
};

/// An interval on which psi(t) = psi + speed tau + acceleration tau^2/2 + curve.angle(tau), tau = t - begin.
struct Segment {
  double begin, end;  ///< the last segment ends at infinity
  double psi, speed, acceleration;
  bool clamped;        ///< balls held at their angles
  SpeedCurve curve{};  ///< if present, `acceleration` is the mean over the segment, and not 0

  double psi_at(double t) const {
    const double line = psi + (speed + 0.5 * acceleration * (t - begin)) * (t - begin);
    return curve.present() ? line + curve.angle(t - begin) : line;
  }
  double speed_at(double t) const {
    const double line = speed + acceleration * (t - begin);
    return curve.present() ? line + curve.speed(t - begin) : line;
  }
  double acceleration_at(double t) const {
    return curve.present() ? acceleration + curve.acceleration(t - begin) : acceleration;
  }
};

/// Cuts the motion at every discontinuity of psi', psi'' and of the clamp (`release_time`), so that a step that ends
/// with a segment meets each exactly. A Hill function is cut into segments on each of which a polynomial gives it to a
/// few roundings of its limit. The last segment is free, at constant speed, without end.
std::vector<Segment> segments(const SpeedProfile& profile, double release_time);

}  // namespace equipoise::model
