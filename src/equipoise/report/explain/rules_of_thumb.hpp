// Rules of thumb for rotors with ball balancers, each a formula: docs/explanation/rules-of-thumb.md derives them and
// says how often each is right.
#pragma once

#include <optional>

#include "equipoise/machine/mechanics/forced_vibration.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::rules {

using model::critical_speeds;
using model::quiet_speed;
using model::shaking_torque;

/// The speed at which a rotor with clamped balls vibrates most in a direction; none if damping leaves no such speed.
std::optional<double> speed_of_largest_vibration(const model::Parameters& p, int direction);

/// The drag below which all balls together may stay at the lowest critical speed while the rotor turns at a higher
/// `speed`: vibration there takes what drag gives. Mean over the balls, weighted by mass.
double drag_against_capture(const model::Parameters& p, double speed);

/// Near balance above the critical speed, balls behave as pendulums: stiffness of the slower of their two modes, over
/// the ball's mass. Not above 0 at or below the critical speed. `phi`: of a balanced state. Mean of unequal supports.
double ball_stiffness(const model::Parameters& p, double speed, const double* phi);

/// The drag with which that pendulum is damped critically.
double settling_drag(const model::Parameters& p, double stiffness);
/// From half of settling_drag() to twice it such a pendulum settles at no less than a quarter of its fastest rate.
inline constexpr double least_of_settling_drag = 0.5, most_of_settling_drag = 2.0, settling_share = 0.25;

/// Time in which a deviation from balance falls to 1/e, of that pendulum or of the rotor on its supports, whichever is
/// longer. Infinite without any damping.
double settling_time(const model::Parameters& p, double stiffness);

/// sum mu_i beta_i / N.
double mean_drag(const model::Parameters& p);

}  // namespace equipoise::rules
