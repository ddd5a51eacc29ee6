// A tilting rotor, turning as one body: the speeds at which it whirls once per turn, and its response to unbalance.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "equipoise/machine/model/bearings.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// Speeds at which, without damping, the rotor's free whirl and its turning are equally fast, ascending. Gyroscopic
/// moments raise those of forward whirl and lower those of backward whirl.
struct WhirlSpeeds {
  /// Of equal supports. Unbalance excites forward whirl alone. A rotor with Jp >= Jt has one such speed only.
  std::vector<double> forward, backward;
  /// Of supports that differ in X and Y, all of which unbalance excites.
  std::vector<double> of_both;

  /// Those that unbalance excites; never empty.
  const std::vector<double>& excited() const { return of_both.empty() ? forward : of_both; }
};

/// `with_balls`: held where they cancel each other.
WhirlSpeeds whirl_speeds(const Parameters& p, bool with_balls);

/// The slowest rate at which a vibration of the rotor with held balls dies out at this speed; 0 or less: one does not.
double slowest_decay(const Parameters& p, double speed);

/// The steady vibration of the rotor, as amplitudes: the real part of these times e^{i speed t}.
struct ShaftVibration {
  using Amplitude = std::complex<double>;
  std::array<Amplitude, 2> centre, slope, force;  // in X and Y; force: on the supports

  std::array<Amplitude, 2> at(double place) const {
    return {centre[0] + place * slope[0], centre[1] + place * slope[1]};
  }
  /// On a bearing, at the speed of the vibration.
  std::array<Amplitude, 2> force_on(const Bearing& bearing, double speed) const;
  /// The largest distance of the section at `place` from the axis.
  double farthest(double place) const;
};
/// Without balls, or with balls held at these angles.
ShaftVibration shaft_vibration(const Parameters& p, double speed, const double* held = nullptr);

}  // namespace equipoise::model
