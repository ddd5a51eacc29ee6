// Torques that bend with the speed: a motor's characteristic, linear between points, and what a machine takes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

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

}  // namespace equipoise::model
