// A rotor that turns with its balls as one body: where it shakes, and what that takes.
#pragma once

#include <array>

#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// sqrt(kappa/(1 + N)), by direction.
std::array<double, 2> critical_speeds(const Parameters& p);

/// sqrt(2) times the highest of them: from there a bare undamped rotor shakes by less than twice its eccentricity.
double quiet_speed(const Parameters& p);

/// The torque that shaking takes from the motor at constant `speed`, in the mean, the rotor as one body with this
/// unbalance. Exact for balls that are held. Infinite at an undamped critical speed.
double shaking_torque(const Parameters& p, double unbalance, double speed);

}  // namespace equipoise::model
