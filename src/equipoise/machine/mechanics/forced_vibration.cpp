// Forced vibration of one body.
#include "equipoise/machine/mechanics/forced_vibration.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/mechanics/whirl.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"

namespace equipoise::model {

namespace {

using Vector = std::array<std::complex<double>, 2>;  // of amplitudes: the real part of v e^{i omega t}

double squares(const Vector& v) { return std::norm(v[0]) + std::norm(v[1]); }

// The largest length of a vector on an ellipse about the origin: its longer half-axis.
double longest(const Vector& v) { return std::sqrt(0.5 * (squares(v) + std::abs(v[0] * v[0] + v[1] * v[1]))); }

// The same with `weight` added in Y. Largest of a cosine and its double: sampled, then a parabola through the best.
double longest(const Vector& v, double weight) {
  if (weight == 0.0) return longest(v);
  constexpr int places = 720;
  const auto square = [&](double angle) {
    const std::complex<double> turn = std::polar(1.0, angle);
    const double x = (v[0] * turn).real(), y = (v[1] * turn).real() + weight;
    return x * x + y * y;
  };
  const double step = two_pi / places;
  int best = 0;
  for (int k = 1; k < places; ++k)
    if (square(k * step) > square(best * step)) best = k;
  const double before = square((best - 1) * step), here = square(best * step), after = square((best + 1) * step);
  const double bend = before - 2.0 * here + after, rise = 0.5 * (after - before);
  return std::sqrt(bend < 0.0 ? here - 0.5 * rise * rise / bend : here);
}

}  // namespace

std::array<double, 2> critical_speeds(const Parameters& p) {
  const double mass = 1.0 + p.total_mass();
  return {std::sqrt(p.stiffness[0] / mass), std::sqrt(p.stiffness[1] / mass)};
}

double highest_critical_speed(const Parameters& p) {
  return p.tilts() ? whirl_speeds(p, false).excited().back() : std::sqrt(std::max(p.stiffness[0], p.stiffness[1]));
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

MotionFigures forced_vibration(const Parameters& p, double unbalance, double speed) {
  const double mass = 1.0 + p.total_mass(), weight = total_weight(p);
  Vector centre, force;
  for (std::size_t d = 0; d < 2; ++d) {
    const std::complex<double> support(p.stiffness[d], p.damping[d] * speed);
    const std::complex<double> ahead = d == 0 ? std::complex<double>(1.0) : std::complex<double>(0.0, -1.0);
    centre[d] = speed == 0.0 ? 0.0 : unbalance * speed * speed * ahead / (support - mass * speed * speed);
    force[d] = support * centre[d];
  }
  return {longest(centre),
          longest(force, -weight),
          std::sqrt(0.5 * squares(force) + weight * weight),
          std::fabs(speed) * std::sqrt(0.5 * squares(centre)),
          unbalance,
          longest(force),
          std::sqrt(0.5 * squares(force)),
          std::fabs(speed) * std::sqrt(0.5) * std::max(std::abs(centre[0]), std::abs(centre[1]))};
}

MotionFigures forced_vibration(const Parameters& p, const double* phi, const std::array<double, 2>& places,
                               const std::vector<Bearing>& bearings, double speed) {
  const ShaftVibration v = shaft_vibration(p, speed, phi);
  MotionFigures result;
  const auto carries = [&](const Vector& force, double weight) {
    result.peak_force = std::max(result.peak_force, longest(force, -weight));
    result.rms_force = std::max(result.rms_force, std::sqrt(0.5 * squares(force) + weight * weight));
    result.peak_dynamic = std::max(result.peak_dynamic, longest(force));
    result.rms_dynamic = std::max(result.rms_dynamic, std::sqrt(0.5 * squares(force)));
  };
  if (bearings.empty()) carries(v.force, total_weight(p));
  for (const Bearing& b : bearings) carries(v.force_on(b, speed), -load_at_rest(p, b));
  for (const double place : places) {
    const Vector section = v.at(place);
    result.radial = std::max(result.radial, longest(section));
    result.rms_velocity = std::max(result.rms_velocity, std::fabs(speed) * std::sqrt(0.5 * squares(section)));
    for (const auto& direction : section)
      result.rms_one_direction =
          std::max(result.rms_one_direction, std::fabs(speed) * std::sqrt(0.5) * std::abs(direction));
  }
  return result;
}

}  // namespace equipoise::model
