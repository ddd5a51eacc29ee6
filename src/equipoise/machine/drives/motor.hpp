// The motor of a driven rotor: torque as a function of time and speed, cut into pieces on which it is smooth.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "equipoise/machine/drives/speed.hpp"

namespace equipoise::model {

/// What a characteristic adds to its first line: at speed at[k] its slope changes by by[k]. Sum of by[k] max(0, w -
/// at[k]), with the speeds in increasing order. This form costs no search and is the same for numbers, their
/// derivatives and SIMD lanes.
struct Bends {
  static constexpr int most = 24;

  int count = 0;
  std::array<double, most> at{}, by{};

  double operator()(double speed) const {
    double sum = 0.0;
    for (int k = 0; k < count; ++k) sum += by[k] * std::max(0.0, speed - at[k]);
    return sum;
  }
  double slope(double speed) const {
    double sum = 0.0;
    for (int k = 0; k < count; ++k) sum += speed > at[k] ? by[k] : 0.0;
    return sum;
  }
};

/// Points that a characteristic may have: each but the last makes one bend.
inline constexpr int most_curve_points = Bends::most + 1;

/// What the driven machine takes at speed w: constant + linear |w| + quadratic w^2, against the rotation. Below
/// `creeping` the constant part falls to nothing with the speed, so that a rotor at rest is not driven by it.
struct Load {
  static constexpr double creeping = 0.01;  ///< in critical speeds

  double constant = 0.0, linear = 0.0, quadratic = 0.0;  ///< each 0 or more

  bool is_none() const { return constant == 0.0 && linear == 0.0 && quadratic == 0.0; }
  double operator()(double speed) const {
    return constant * std::clamp(speed / creeping, -1.0, 1.0) + linear * speed + quadratic * speed * std::fabs(speed);
  }
  double slope(double speed) const {
    return (std::fabs(speed) < creeping ? constant / creeping : 0.0) + linear + 2.0 * quadratic * std::fabs(speed);
  }
};

/// tau(t, psi') in units of M R^2 omega_c^2. Torque laws of a motor: docs/explanation/equations.md, "A motor".
struct MotorLaw {
  enum class Kind {
    linear,   ///< constant + slope psi', and 0 from `until` on
    table,    ///< linear between `times`, constant outside them
    control,  ///< gain e + integral (time integral of e) with e = aim(t) - psi', cut to |tau| <= limit
    curve,    ///< linear between `speeds`, constant below the first; above the last the last line goes on
  };
  Kind kind = Kind::linear;
  double constant = 0.0, slope = 0.0;  ///< linear: tau = constant + slope psi' until `until`, then 0
  std::optional<double> until;         ///< linear
  std::vector<double> times;           ///< table
  std::vector<double> speeds;          ///< curve: increasing
  std::vector<double> values;          ///< table, curve
  double gain = 0.0, integral = 0.0;   ///< control: torque per speed error, and its rate
  std::optional<double> limit;         ///< control: largest |tau|
  SpeedProfile aim;                    ///< control
  Load load;                           ///< what the machine takes, whatever the motor

  /// The speed at which a balanced rotor ends up: where motor and load are even for good. Empty if there is none.
  std::optional<double> final_speed() const;
};

/// An interval on which the motor gives cut(constant + slope psi' + bends(psi') + rate (t - begin) + integral E), with
/// E' = target' - psi': dE/dt = aim + aim_rate (t - begin) - psi', but 0 while that would push a cut torque further
/// out. The load takes its own of that.
struct DriveSegment {
  double begin, end;  ///< the last segment ends at infinity
  double constant = 0.0, slope = 0.0, rate = 0.0;
  double integral = 0.0, aim = 0.0, aim_rate = 0.0;
  double limit = std::numeric_limits<double>::infinity();
  Bends bends{};
  Load load{};

  /// On the rotor: the motor's less the load's.
  double torque(double t, double speed, double error_integral) const;
  double motor_torque(double t, double speed, double error_integral) const;
  /// dE/dt.
  double error_rate(double t, double speed, double error_integral) const;
  /// Whether a torque of this piece is linear in psi' until it is cut.
  bool is_linear() const { return bends.count == 0 && load.is_none(); }
  /// Whether nothing acts on the rotor, whatever its speed.
  bool is_idle() const;
  /// Whether the torque brakes a rotor that is fast enough, or a control brings it to its speed.
  bool brakes() const;
  /// The speed at which the torque at the piece's begin, without error, is `damping` psi': where it falls through that
  /// line, and of several the fastest in the sense of the torque at rest. For a linear torque its only such speed,
  /// stable or not. Empty if there is none.
  std::optional<double> even_speed(double damping) const;
  /// The same drive of a rotor that turns the other way.
  DriveSegment mirrored() const;

 private:
  double uncut(double t, double speed, double error_integral) const;
};

/// The pieces of a motor's law, contiguous from 0, the last without end.
std::vector<DriveSegment> drive_segments(const MotorLaw& law);

/// What a nameplate or catalogue states of an induction motor, in SI units.
struct Nameplate {
  double rated_torque = 0.0;                 ///< N m
  double rated_speed = 0.0;                  ///< rad/s
  double synchronous_speed = 0.0;            ///< rad/s, above rated_speed
  double breakdown_ratio = 0.0;              ///< breakdown torque over rated torque, > 1
  std::optional<double> locked_rotor_ratio;  ///< torque at rest over rated torque
};

/// A motor's curve, as points between which torque is linear.
struct CurvePoints {
  std::vector<double> speeds, torques;
};

/// Slip at the breakdown torque, so that Kloss's formula gives the rated torque at the rated speed.
double breakdown_slip(const Nameplate& motor);

/// Kloss's formula, T = 2 T_b/(s/s_b + s_b/s) with slip s (R. Fischer, Elektrische Maschinen, Hanser). With a
/// locked-rotor ratio, slips beyond breakdown are corrected by a factor that is linear in s, 1 at breakdown.
double nameplate_torque(const Nameplate& motor, double speed);

/// The curve from rest to the synchronous speed, by the points at which it bends most: nowhere off by more than 1 % of
/// the breakdown torque.
CurvePoints nameplate_curve(const Nameplate& motor);

/// Speeds at which an induction motor at 50 or 60 Hz has no slip and that a rated speed may belong to: those above it
/// by at most a tenth, increasing. rad/s.
std::vector<double> synchronous_speeds(double rated_speed);

}  // namespace equipoise::model
