// Forced vibration of one body.
#include "equipoise/mechanics/forced_vibration.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equipoise::model {

std::array<double, 2> critical_speeds(const Parameters& p) {
  const double mass = 1.0 + p.total_mass();
  return {std::sqrt(p.stiffness[0] / mass), std::sqrt(p.stiffness[1] / mass)};
}

double quiet_speed(const Parameters& p) {
  const std::array<double, 2> critical = critical_speeds(p);
  return std::sqrt(2.0) * std::max(critical[0], critical[1]);
}

double shaking_torque(const Parameters& p, double unbalance, double speed) {
  const double mass = 1.0 + p.total_mass();
  double sum = 0.0;
  for (std::size_t d = 0; d < 2; ++d) {
    const double spring = p.stiffness[d] - mass * speed * speed, damper = p.damping[d] * speed;
    const double left = spring * spring + damper * damper;
    // At a critical speed, up to a few roundings.
    if (damper == 0.0 && std::abs(spring) < 1e-14 * p.stiffness[d]) return std::numeric_limits<double>::infinity();
    sum += p.damping[d] / left;
  }
  return 0.5 * unbalance * unbalance * std::pow(speed, 5) * sum;
}

}  // namespace equipoise::model
