// Forced vibration of rotor and balls turning as one body: its critical speeds, the torque it absorbs, its steady
// motion.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "equipoise/machine/model/bearings.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// sqrt(kappa/(1 + N)), by direction.
std::array<double, 2> critical_speeds(const Parameters& p);

/// The highest one of the rotor without balls, whether it tilts or not.
double highest_critical_speed(const Parameters& p);

/// sqrt(2) times the higher critical speed: above it a bare undamped rotor vibrates less than twice its eccentricity.
double quiet_speed(const Parameters& p);

/// Mean torque that vibration takes from the motor at constant `speed`, for one body with this unbalance. Exact if the
/// balls are held. Infinite at an undamped critical speed.
double shaking_torque(const Parameters& p, double unbalance, double speed);

/// Figures of a steady motion. All zero: exact balance.
struct MotionFigures {
  double radial = 0.0;      ///< largest distance of the centre from where the rotor rests under its weight
  double peak_force = 0.0;  ///< largest bearing force, the weight included
  double rms_force = 0.0;   ///< the weight included
  double rms_velocity = 0.0;
  double unbalance = 0.0;                        ///< size of the mean
  double peak_dynamic = 0.0, rms_dynamic = 0.0;  ///< bearing force without the weight
  double rms_one_direction = 0.0;                ///< velocity in X or Y, whichever has more
};

/// Of one body with this unbalance at constant `speed`. With damping in both directions it ends in no other motion.
MotionFigures forced_vibration(const Parameters& p, double unbalance, double speed);

/// The same of a tilting rotor with its balls held at `phi`, at the worse of these places along its shaft. The force
/// is that of the bearing that takes most, or without `bearings` that of all supports together.
MotionFigures forced_vibration(const Parameters& p, const double* phi, const std::array<double, 2>& places,
                               const std::vector<Bearing>& bearings, double speed);

/// About the axis, in M R^2; p.inertia is about the centre of mass.
inline double turning_inertia(const Parameters& p) {
  return p.inertia + p.eccentricity * p.eccentricity + p.total_mass();
}

}  // namespace equipoise::model
