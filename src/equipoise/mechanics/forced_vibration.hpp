// Forced vibration of rotor and balls turning as one body: its critical speeds and the torque it absorbs.
#pragma once

#include <array>

#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// sqrt(kappa/(1 + N)), by direction.
std::array<double, 2> critical_speeds(const Parameters& p);

/// sqrt(2) times the higher critical speed: above it a bare undamped rotor vibrates less than twice its eccentricity.
double quiet_speed(const Parameters& p);

/// Mean torque that vibration takes from the motor at constant `speed`, for one body with this unbalance. Exact if the
/// balls are held. Infinite at an undamped critical speed.
double shaking_torque(const Parameters& p, double unbalance, double speed);

}  // namespace equipoise::model
