// The formulas of docs/explanation/rules-of-thumb.md.
#include "equipoise/report/explain/rules_of_thumb.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace equipoise::rules {

namespace {

double mean(const std::array<double, 2>& pair) { return 0.5 * (pair[0] + pair[1]); }

// Decay of m s'' + c s' + k s = 0: of its slower part.
double decay(double m, double c, double k) { return (c - std::sqrt(std::max(0.0, c * c - 4.0 * m * k))) / (2.0 * m); }

}  // namespace

std::optional<double> speed_of_largest_vibration(const model::Parameters& p, int direction) {
  const auto d = static_cast<std::size_t>(direction);
  const double part = p.damping[d] * p.damping[d] / (2.0 * (1.0 + p.total_mass()) * p.stiffness[d]);
  if (part >= 1.0) return std::nullopt;
  return critical_speeds(p)[d] / std::sqrt(1.0 - part);
}

double drag_against_capture(const model::Parameters& p, double speed) {
  const std::array<double, 2> critical = critical_speeds(p);
  const double lowest = std::min(critical[0], critical[1]), all = p.total_mass();
  return shaking_torque(p, all, lowest) / (all * (speed - lowest));
}

double ball_stiffness(const model::Parameters& p, double speed, const double* phi) {
  std::complex<double> doubled;
  for (int i = 0; i < p.balls; ++i) doubled += std::polar(p.mass[static_cast<std::size_t>(i)], 2.0 * phi[i]);
  // One ball, and two that balance each other, have one way only to leave balance by: across their line.
  const bool one_way = p.balls == 1 || (p.balls == 2 && p.eccentricity == 0.0);
  const double slower = 0.5 * (p.total_mass() + (one_way ? 1.0 : -1.0) * std::abs(doubled));
  const double square = speed * speed, spring = (1.0 + p.total_mass()) * square - mean(p.stiffness);
  const double damper = mean(p.damping) * speed;
  return slower * square * square * spring / (spring * spring + damper * damper);
}

double settling_drag(const model::Parameters& p, double stiffness) {
  return 2.0 * std::sqrt(p.inertia_along_race() * stiffness);
}

double settling_time(const model::Parameters& p, double stiffness) {
  const double balls = decay(p.inertia_along_race(), mean_drag(p), stiffness);
  const double rotor = decay(1.0 + p.total_mass(), mean(p.damping), mean(p.stiffness));
  return 1.0 / std::min(balls, rotor);
}

double mean_drag(const model::Parameters& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.balls); ++i) sum += p.mass[i] * p.drag[i];
  return sum / p.total_mass();
}

}  // namespace equipoise::rules
