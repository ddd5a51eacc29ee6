// The torque of an induction motor from its nameplate, by Kloss's formula.
#pragma once

#include <optional>
#include <vector>

namespace equipoise::model {

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
