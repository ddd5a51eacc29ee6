// Trajectories of a rotor that tilts in fixed axes, sampled densely, and what transients are by these samples.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/columns/transient_figures.hpp"
#include "equipoise/study/study.hpp"
#include "tilt_fixed_flow.hpp"

namespace equipoise::tilting {

// A bearing as it is stated: springs and dampers in X and Y.
struct Held {
  double at;
  std::array<double, 2> stiffness, damping;
};

// What is watched at one time: the worst of some places.
struct Seen {
  double t = 0.0, radial = 0.0;
  std::vector<double> force;      // of each bearing, or of all supports together
  std::vector<double> velocity2;  // by place
  double power = 0.0;             // of a motor
  double unbalance = 0.0;
};

// Centre and slope where the rotor rests, by Cramer's rule.
inline std::array<double, 2> rest_of(const model::Parameters& p) {
  double mass = 1.0, first = 0.0;
  for (int i = 0; i < p.balls; ++i) {
    mass += p.mass[i];
    first += p.mass[i] * p.tilt.plane[i];
  }
  const double a = p.stiffness[1], b = p.tilt.stiffness[1][0], c = p.tilt.stiffness[1][1], d = a * c - b * b;
  return {-p.gravity * (mass * c - first * b) / d, -p.gravity * (first * a - mass * b) / d};
}

inline Seen seen(const model::Parameters& p, const std::vector<double>& places, const FixedFlow& flow, double t,
                 const double* y, const std::vector<Held>& bearings = {}) {
  const Fixed f = flow.state(y);
  const std::array<double, 2> rest = rest_of(p);
  Seen s;
  s.t = t;
  for (const double z : places) {
    s.radial = std::max(s.radial, std::abs(f.q1 - i1 * rest[0] + z * (f.q2 - i1 * rest[1])));
    s.velocity2.push_back(std::norm(f.v1 + z * f.v2));
  }
  s.power = (flow.constant + flow.slope * f.w) * f.w;
  if (bearings.empty()) s.force.push_back(std::abs(supports(p, f)[0]));
  for (const Held& b : bearings) {
    const Complex place = f.q1 + b.at * f.q2, rate = f.v1 + b.at * f.v2;
    s.force.push_back(std::hypot(b.stiffness[0] * place.real() + b.damping[0] * rate.real(),
                                 b.stiffness[1] * place.imag() + b.damping[1] * rate.imag()));
  }
  Complex unbalance = std::polar(p.eccentricity, f.psi + p.eccentricity_angle);
  for (int i = 0; i < p.balls; ++i) unbalance += std::polar(p.mass[i], f.theta[i]);
  s.unbalance = std::abs(unbalance);
  return s;
}

// A stretch of a run: its balls are held or not, and psi'' is this.
struct Stretch {
  double begin, end;
  bool held;
  double acceleration;
};
inline std::vector<Stretch> stretches(const Study& s, double until) {
  if (s.speed.profile == Profile::constant || s.speed.driven()) return {{0.0, until, false, 0.0}};
  const double release = s.release_time(), ramp = s.speed.duration, rate = (s.speed.final - s.speed.initial) / ramp;
  const double first = std::min(release, ramp);
  return {{0.0, first, true, rate}, {first, ramp, false, rate}, {ramp, until, false, 0.0}};
}

// 200 times in a unit of time: what lies between them is below 1e-4 of a peak.
inline std::vector<Seen> dense(const Study& s, const std::vector<Stretch>& over, const std::vector<double>& places,
                               const std::vector<Held>& bearings = {}) {
  constexpr double step = 1.0 / 200.0;
  std::vector<Seen> all;
  std::array<double, most> y = first_state(s, s.speed.profile == Profile::constant ? s.speed.speed : s.speed.initial);
  HWY_NAMESPACE::ErrorScale<most> scale;
  scale.tolerance = 1e-11;
  scale.floor.fill(1e-3);
  for (const Stretch& one : over) {
    if (!(one.begin < one.end)) continue;
    FixedFlow flow{s.parameters, one.held, one.acceleration};
    if (s.speed.driven()) {
      flow.driven = true;
      flow.constant = s.speed.torque.constant;
      flow.slope = s.speed.torque.slope;
    }
    const auto count = static_cast<std::size_t>(std::ceil((one.end - one.begin) / step));
    std::size_t next = 0;
    HWY_NAMESPACE::AdaptiveIntegrator<FixedFlow, most> integrator(flow, scale, 2 * flow.half());
    const auto at = [&](std::size_t k) { return one.begin + (one.end - one.begin) * static_cast<double>(k) / count; };
    const IntegrationStatus status =
        integrator.advance(one.begin, one.end, y.data(), [&](double, double to, auto&& state) {
          for (; next <= count && at(next) <= to; ++next) {
            std::array<double, most> z{};
            state(at(next), z.data());
            all.push_back(seen(s.parameters, places, flow, at(next), z.data(), bearings));
          }
        });
    EXPECT_EQ(status, IntegrationStatus::done);
  }
  return all;
}

// What transient_row() tells, of dense samples; windows begin at `window_begin`.
inline TransientRow figures(const TransientSettings& asked, const std::vector<Seen>& all, double window_begin) {
  TransientRow row;
  double before = 0.0, after = 0.0, end = 0.0, force = 0.0, above = 0.0, last = 0.0, length = 0.0;
  double unbalance = 0.0, work = 0.0;
  std::vector<double> velocity2(all.front().velocity2.size()), force2(all.front().force.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Seen& s = all[k];
    double& peak = s.t < asked.release ? before : after;
    peak = std::max(peak, s.radial);
    force = std::max(force, *std::max_element(s.force.begin(), s.force.end()));
    if (s.t >= asked.release && s.radial > asked.settled) last = s.t;
    if (k == 0) continue;
    const double h = s.t - all[k - 1].t;
    work += 0.5 * h * (all[k - 1].power + s.power);
    if (s.radial > asked.displacement) above += h;
    if (all[k - 1].t < window_begin) continue;
    end = std::max(end, s.radial);
    length += h;
    for (std::size_t i = 0; i < force2.size(); ++i)
      force2[i] += 0.5 * h * (all[k - 1].force[i] * all[k - 1].force[i] + s.force[i] * s.force[i]);
    unbalance += 0.5 * h * (all[k - 1].unbalance + s.unbalance);
    for (std::size_t i = 0; i < velocity2.size(); ++i)
      velocity2[i] += 0.5 * h * (all[k - 1].velocity2[i] + s.velocity2[i]);
  }
  const auto number = [](double v) { return static_cast<float>(v); };
  row.peak_radial = number(std::max(before, after));
  row.peak_radial_after_release = number(after);
  row.peak_radial_at_end = number(end);
  row.peak_force = number(force);
  row.rms_force = number(std::sqrt(*std::max_element(force2.begin(), force2.end()) / length));
  row.rms_velocity = number(std::sqrt(*std::max_element(velocity2.begin(), velocity2.end()) / length));
  row.residual_unbalance = number(unbalance / length);
  row.energy = number(work);
  constexpr float endless = std::numeric_limits<float>::infinity();
  row.time_above = end <= asked.displacement ? number(above) : endless;
  row.settling_time = end <= asked.settled ? number(std::max(0.0, last - asked.release)) : endless;
  row.followed_until = number(all.back().t);
  return row;
}

}  // namespace equipoise::tilting
