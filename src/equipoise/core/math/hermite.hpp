// Cubic interpolation between two points and the slopes there.
#pragma once

#include <Eigen/Core>

namespace equipoise {

/// The value at fraction `s` of a step `h` from `a` to `b`.
inline Eigen::VectorXd hermite(double s, double h, const Eigen::VectorXd& a, const Eigen::VectorXd& slope_a,
                               const Eigen::VectorXd& b, const Eigen::VectorXd& slope_b) {
  const double r = 1.0 - s;
  return r * r * (1.0 + 2.0 * s) * a + s * s * (3.0 - 2.0 * s) * b + h * s * r * (r * slope_a - s * slope_b);
}

}  // namespace equipoise
