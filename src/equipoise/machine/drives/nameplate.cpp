// Kloss's formula, its points, and speeds without slip.
#include "equipoise/machine/drives/nameplate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/drives/motor.hpp"

namespace equipoise::model {

namespace {
double slip(const Nameplate& motor, double speed) { return 1.0 - speed / motor.synchronous_speed; }
}  // namespace

double breakdown_slip(const Nameplate& motor) {
  const double k = motor.breakdown_ratio;
  return slip(motor, motor.rated_speed) * (k + std::sqrt(k * k - 1.0));
}

double nameplate_torque(const Nameplate& motor, double speed) {
  const double s = slip(motor, speed), top = breakdown_slip(motor);
  const auto kloss = [&](double at) {
    return 2.0 * motor.breakdown_ratio * motor.rated_torque * at * top / (at * at + top * top);
  };
  if (!motor.locked_rotor_ratio || s <= top || top >= 1.0) return kloss(s);
  // Kloss's torque lies (s - top)^2/(s^2 + top^2) of the breakdown torque below it. If what is added grows as (s -
  // top)^2, the sum stays below it as well.
  const double way = (s - top) / (1.0 - top);
  return kloss(s) + (*motor.locked_rotor_ratio * motor.rated_torque - kloss(1.0)) * way * way;
}

CurvePoints nameplate_curve(const Nameplate& motor) {
  constexpr int samples = 4000;
  constexpr std::size_t points = 20;
  static_assert(points <= static_cast<std::size_t>(most_curve_points));
  const auto speed = [&](int i) { return motor.synchronous_speed * i / samples; };
  std::vector<double> torque;
  for (int i = 0; i <= samples; ++i) torque.push_back(nameplate_torque(motor, speed(i)));
  // The sample that is furthest from its chord becomes the next point.
  std::vector<int> chosen{0, samples};
  while (chosen.size() < points) {
    int farthest = 0;
    double most = 0.0;
    for (std::size_t k = 1; k < chosen.size(); ++k) {
      const int low = chosen[k - 1], high = chosen[k];
      for (int i = low + 1; i < high; ++i) {
        const double share = static_cast<double>(i - low) / (high - low);
        const double off = std::fabs(torque[i] - (torque[low] + share * (torque[high] - torque[low])));
        if (off > most) {
          most = off;
          farthest = i;
        }
      }
    }
    if (most == 0.0) break;
    chosen.insert(std::upper_bound(chosen.begin(), chosen.end(), farthest), farthest);
  }
  CurvePoints curve;
  for (const int i : chosen) {
    curve.speeds.push_back(speed(i));
    curve.torques.push_back(torque[i]);
  }
  return curve;
}

std::vector<double> synchronous_speeds(double rated_speed) {
  constexpr double largest_excess = 0.1;
  constexpr int most_pole_pairs = 24;
  std::vector<double> speeds;
  for (const double mains : {50.0, 60.0})
    for (int pairs = 1; pairs <= most_pole_pairs; ++pairs) {
      const double speed = two_pi * mains / pairs;
      if (speed > rated_speed && speed <= (1.0 + largest_excess) * rated_speed) speeds.push_back(speed);
    }
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end(), [](double a, double b) { return b - a < 1e-9 * b; }),
               speeds.end());
  return speeds;
}

}  // namespace equipoise::model
