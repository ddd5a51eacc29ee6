// The weighting filter as its transfer function.
#include "equipoise/machine/standards/hand_arm.hpp"

#include <cmath>
#include <complex>

#include "equipoise/core/base/angles.hpp"

namespace equipoise::standards {

double hand_arm_weighting(double frequency) {
  // Band limits, and the step from acceleration to velocity. With the rounded 0.71 for 1/sqrt(2) that ISO 5349-1 prints,
  // its own table of factors is not met.
  const double lower = two_pi * std::pow(10.0, 0.8), upper = two_pi * std::pow(10.0, 3.1), step = 100.0;
  const double band_quality = 1.0 / std::sqrt(2.0), step_quality = 0.64;
  const std::complex<double> s(0.0, two_pi * frequency);
  const std::complex<double> high = 1.0 / (1.0 + lower / (band_quality * s) + (lower / s) * (lower / s)),
                             low = 1.0 / (1.0 + s / (band_quality * upper) + (s / upper) * (s / upper)),
                             turn = (1.0 + s / step) / (1.0 + s / (step_quality * step) + (s / step) * (s / step));
  return std::abs(high * low * turn);
}

double hand_arm_acceleration(double frequency, double rms_velocity) {
  return hand_arm_weighting(frequency) * two_pi * frequency * rms_velocity;
}

double hours_to_exposure(double acceleration, double value) {
  return 8.0 * (value / acceleration) * (value / acceleration);
}

}  // namespace equipoise::standards
