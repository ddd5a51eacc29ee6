// Trajectories, fates and eigenvalues of a rotor that tilts in fixed axes.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/integrate/adaptive-inl.hpp"
#include "equipoise/study/study.hpp"
#include "tilt_fixed_axes.hpp"

namespace equipoise::tilting {

inline constexpr const char* long_rotor = R"(
[rotor]
eccentricity = 0.005
eccentricity_angle = 1.0
damping = 0.02
[rotor.tilt]
transverse_inertia = 3.25
polar_inertia = 0.5
misalignment = 0.005
stiffness = [0.0, 9.0]
damping = [0.0, 0.18]
[balancer]
balls = 4
plane = [2, 2, -2, -2]
mass = 0.005
drag = 0.01
[speed]
profile = "constant"
speed = 3.5
[initial]
phi = [1.5707963267948966, -1.5707963267948966, 1.5707963267948966, -1.5707963267948966]
)";

// Integrates in fixed axes: X, Y, SX, SY, theta_i, psi and their rates.
struct FixedFlow {
  const model::Parameters& p;
  bool held;
  double acceleration;                 // prescribed psi''
  double constant = 0.0, slope = 0.0;  // or the motor's torque
  bool driven = false;

  int half() const { return 5 + p.balls; }
  Fixed state(const double* y) const {
    const int n = p.balls, h = half();
    Fixed f;
    f.q1 = {y[0], y[1]};
    f.q2 = {y[2], y[3]};
    f.v1 = {y[h], y[h + 1]};
    f.v2 = {y[h + 2], y[h + 3]};
    f.psi = y[4 + n];
    f.w = y[h + 4 + n];
    for (int i = 0; i < n; ++i) {
      f.theta.push_back(y[4 + i]);
      f.rate.push_back(y[h + 4 + i]);
    }
    return f;
  }
  // One body: masses of balls at (mu_i, z_i) turn with the rotor.
  VectorXd as_one(const Fixed& f) const {
    double mass = 1.0, first = 0.0, second = p.tilt.transverse_inertia;
    Complex unbalance = std::polar(p.eccentricity, f.psi + p.eccentricity_angle),
            couple = p.tilt.couple() * std::polar(1.0, f.psi);
    for (int i = 0; i < p.balls; ++i) {
      const Complex one = std::polar(p.mass[i], f.theta[i]);
      mass += p.mass[i];
      first += p.mass[i] * p.tilt.plane[i];
      second += p.mass[i] * p.tilt.plane[i] * p.tilt.plane[i];
      unbalance += one;
      couple += p.tilt.plane[i] * one;
    }
    const auto s = supports(p, f);
    const Complex turning = f.w * f.w - i1 * acceleration, force = turning * unbalance - s[0] - i1 * p.gravity * mass,
                  moment = turning * couple - s[1] + i1 * f.w * p.tilt.polar_inertia * f.v2 - i1 * p.gravity * first;
    const double determinant = mass * second - first * first;
    const Complex a = (force * second - moment * first) / determinant,
                  b = (moment * mass - force * first) / determinant;
    VectorXd result = VectorXd::Constant(half(), acceleration);
    result.head(4) << a.real(), a.imag(), b.real(), b.imag();
    return result;
  }
  void operator()(double, const double* y, double* dy) const {
    const Fixed f = state(y);
    const double torque = constant + slope * f.w;
    const VectorXd a = held ? as_one(f) : accelerations(p, f, driven ? &torque : nullptr, acceleration);
    for (int k = 0; k < half(); ++k) {
      dy[k] = y[half() + k];
      dy[half() + k] = a[k];
    }
  }
};

inline constexpr int most = 2 * (5 + 6);

// False if the integration fails.
inline bool advance(const FixedFlow& flow, double begin, double end, std::array<double, most>& y,
                    double tolerance = 1e-13) {
  if (!(begin < end)) return true;
  HWY_NAMESPACE::ErrorScale<most> scale;
  scale.tolerance = tolerance;
  scale.floor.fill(1e-3);
  HWY_NAMESPACE::AdaptiveIntegrator<FixedFlow, most> integrator(flow, scale, 2 * flow.half());
  return integrator.advance(begin, end, y.data(), [](double, double, auto&&) {}) == IntegrationStatus::done;
}

inline std::array<double, most> first_state(const Study& s, double speed) {
  const model::Parameters& p = s.parameters;
  const int n = p.balls, h = 5 + n;
  std::array<double, most> y{};
  const InitialState& i = s.initial;
  const Complex turn = std::polar(1.0, i.psi), z(i.x, i.y), slope(i.tilt_x, i.tilt_y);
  const auto put = [&](int k, Complex v) {
    y[static_cast<std::size_t>(k)] = v.real();
    y[static_cast<std::size_t>(k) + 1] = v.imag();
  };
  put(0, z * turn);
  put(2, slope * turn);
  put(h, (Complex(i.x_dot, i.y_dot) + i1 * speed * z) * turn);
  put(h + 2, (Complex(i.tilt_x_dot, i.tilt_y_dot) + i1 * speed * slope) * turn);
  for (int k = 0; k < n; ++k) {
    y[static_cast<std::size_t>(4 + k)] = i.psi + i.phi[static_cast<std::size_t>(k)];
    y[static_cast<std::size_t>(h + 4 + k)] = speed + i.phi_dot[static_cast<std::size_t>(k)];
  }
  y[static_cast<std::size_t>(4 + n)] = i.psi;
  y[static_cast<std::size_t>(h + 4 + n)] = speed;
  return y;
}

inline Study long_rotor_with(const std::vector<std::string>& overrides = {}) {
  return parse_study(long_rotor, "rotor", overrides);
}

// Damped well, so that motions settle soon.
inline std::vector<std::string> damped(std::vector<std::string> more) {
  for (const char* key : {"rotor.damping=0.2", "rotor.tilt.damping=[0, 1.8]", "balancer.drag=0.3"}) more.push_back(key);
  return more;
}

// dy/dt in turning axes by the equations in fixed axes, at psi = 0.
inline VectorXd fixed_rate(const model::System& system, const VectorXd& y) {
  const model::Parameters& p = system.parameters();
  const int n = p.balls, t = system.layout().tilt;
  const double w = system.speed();
  const VectorXd a = accelerations(p, fixed_of(p, system, y, 0.0, w), nullptr, 0.0);
  VectorXd rate(y.size());
  const auto put = [&](int place, int of) {
    rate[place] = y[place + 2] + w * y[place + 1];
    rate[place + 1] = y[place + 3] - w * y[place];
    rate[place + 2] = a[of] + w * y[place + 3];
    rate[place + 3] = a[of + 1] - w * y[place + 2];
  };
  put(0, 0);
  put(t, 2);
  for (int i = 0; i < n; ++i) {
    rate[model::index::phi(i)] = y[model::index::q(i, n)];
    rate[model::index::q(i, n)] = a[4 + i];
  }
  return rate;
}

inline Eigen::VectorXcd fixed_eigenvalues(const model::System& system, const VectorXd& y) {
  constexpr double step = 1e-5;
  MatrixXd jacobian(y.size(), y.size());
  for (int k = 0; k < y.size(); ++k) {
    VectorXd more = y, less = y;
    more[k] += step;
    less[k] -= step;
    jacobian.col(k) = (fixed_rate(system, more) - fixed_rate(system, less)) / (2.0 * step);
  }
  return jacobian.eigenvalues();
}

// The farthest that an eigenvalue of `a` is from the nearest one of `b`.
inline double farthest(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  double worst = 0.0;
  for (const Complex& value : a) worst = std::max(worst, (b.array() - value).abs().minCoeff());
  return worst;
}

// Differences have errors of step^2 and of rounding over the step, both near 1e-10; balls that rest nearly alike have
// nearly double eigenvalues, which the root of that moves.
inline constexpr double same_eigenvalue = 2e-5;

// How many balls drift, by a motion's name.
inline int drifting_by(const std::string& name) {
  if (name.starts_with("locked") || name.starts_with("balanced")) return 0;
  const std::size_t comma = name.find(", ");
  if (name.find("captured") == std::string::npos) return 4;
  return comma == std::string::npos ? -1 : std::stoi(name.substr(comma + 2));
}

// How many of four balls drift long after the start, followed in fixed axes: at a constant speed, after a ramp from
// rest that holds them, or under a motor with the torque constant + slope psi'. `end`: the state then.
inline int drifting_in_fixed_axes(const Study& own, double tolerance, std::array<double, most>* end = nullptr) {
  constexpr double until = 1500.0, watched = 60.0;
  FixedFlow flow{own.parameters, false, 0.0};
  if (own.speed.driven()) {
    flow.driven = true;
    flow.constant = own.speed.torque.constant;
    flow.slope = own.speed.torque.slope;
  }
  const double release = own.release_time();
  std::array<double, most> y =
      first_state(own, own.speed.profile == Profile::constant ? own.speed.speed : own.speed.initial);
  if (release > 0.0) {
    const FixedFlow held{own.parameters, true, (own.speed.final - own.speed.initial) / release};
    EXPECT_TRUE(advance(held, 0.0, release, y, tolerance));
  }
  EXPECT_TRUE(advance(flow, release, until, y, tolerance));
  const std::array<double, most> before = y;
  EXPECT_TRUE(advance(flow, 0.0, watched, y, tolerance));
  if (end) *end = y;
  int drifting = 0;
  for (std::size_t k = 4; k < 8; ++k) drifting += (y[k] - before[k] - (y[8] - before[8])) / watched < -0.5;
  return drifting;
}

}  // namespace equipoise::tilting
