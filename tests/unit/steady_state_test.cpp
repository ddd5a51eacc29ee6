// Motions known in closed form: the clamped rotor's steady response, and equilibria of the free one.
#include <Eigen/Dense>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace steady_state_test {

using namespace std::complex_literals;
using Complex = std::complex<double>;
using equipoise::Study;
namespace model = equipoise::model;

// Three unequal balls held for good at constant speed `w`.
Study clamped_rotor(double w) {
  Study s;
  s.parameters.balls = 3;
  s.parameters.mass = {0.05, 0.03, 0.04};
  s.parameters.drag.fill(0.1);
  s.speed.speed = w;
  s.release.time = 400.0;
  s.initial.psi = 0.4;
  s.initial.x = 0.1;
  s.initial.y_dot = -0.2;
  s.initial.phi = {0.3, 1.9, -1.2};
  return s;
}

Complex unbalance(const Study& s) {
  Complex u = s.parameters.eccentricity;
  for (int i = 0; i < s.parameters.balls; ++i) u += std::polar(s.parameters.mass[i], s.initial.phi[i]);
  return u;
}

// By then the remainder of the start, exp(-zeta t / (2 (1 + N))), is below 1e-20 (zeta at least 0.35).
const std::vector<double> late{320.0, 323.7, 351.2, 399.0};

// simulate() is accurate to 1e-9 relative over 100 time units; here the start is forgotten and errors do not add up.
constexpr double allowed = 1e-11;

TEST(ClampedSteadyResponse, IsTheClosedFormOnIsotropicSupports) {
  double largest = 0.0;
  for (double w : {-2.4, 0.3, 0.8, 0.945, 1.0, 1.5, 2.4, 5.0}) {
    const Study s = clamped_rotor(w);
    const double total = 1.0 + s.parameters.total_mass(), zeta = s.parameters.damping[0];
    const Complex u = unbalance(s), z = u * w * w / (1.0 - total * w * w + 1i * zeta * w);
    const double r = std::abs(u) * w * w / std::hypot(1.0 - total * w * w, zeta * w);
    const auto run = equipoise::simulate(s, late);
    ASSERT_EQ(run.t, late);
    for (std::size_t k = 0; k < late.size(); ++k) {
      EXPECT_NEAR(run.radial[k], r, allowed * r) << "speed " << w;
      EXPECT_LT(std::abs(Complex(run.x[k], run.y[k]) - z), allowed * r) << "speed " << w;
      EXPECT_LT(std::hypot(run.x_dot[k], run.y_dot[k]), allowed * r) << "speed " << w;
      const Complex force = (1.0 + 1i * zeta * w) * z * std::polar(1.0, s.initial.psi + w * late[k]);
      EXPECT_LT(std::abs(Complex(run.bearing_x[k], run.bearing_y[k]) - force), 10.0 * allowed * r) << "speed " << w;
      largest = std::max(largest, std::abs(Complex(run.x[k], run.y[k]) - z) / r);
    }
  }
  RecordProperty("largest_relative_error", fmt::format("{:.2g}", largest));
}

TEST(ClampedSteadyResponse, IsTheClosedFormOnAnisotropicSupportsUnderGravity) {
  double largest = 0.0;
  for (double w : {0.6, 1.1, 2.4}) {
    Study s = clamped_rotor(w);
    auto& p = s.parameters;
    p.damping = {0.5, 0.35};
    p.stiffness = {1.0, 1.7};
    p.gravity = 0.02;
    const double total = 1.0 + p.total_mass();
    const auto response = [&](int axis) {
      return w * w / (p.stiffness[axis] - total * w * w + 1i * p.damping[axis] * w);
    };
    const auto run = equipoise::simulate(s, late);
    ASSERT_EQ(run.t, late);
    for (std::size_t k = 0; k < late.size(); ++k) {
      // Each axis is an independent oscillator, driven by the real and imaginary parts of U w^2 e^{i psi}.
      const Complex turn = std::polar(1.0, s.initial.psi + w * late[k]), drive = unbalance(s) * turn;
      const double X = (response(0) * drive).real(),
                   Y = (response(1) * drive).imag() - total * p.gravity / p.stiffness[1];
      const double size = std::abs(unbalance(s)) * std::max(std::abs(response(0)), std::abs(response(1)));
      const double error = std::abs(Complex(run.x[k], run.y[k]) * turn - Complex(X, Y));
      EXPECT_LT(error, allowed * size) << "speed " << w;
      largest = std::max(largest, error / size);
    }
  }
  RecordProperty("largest_relative_error", fmt::format("{:.2g}", largest));
}

// One ball at rest in the race, on the side that the rotor moved to (sign +1) or opposite (-1).
struct Synchronous {
  double r, state[6];
};

std::vector<Synchronous> synchronous_states(const model::Parameters& p, double w) {
  const double mu = p.mass[0], k = 1.0 - (1.0 + mu) * w * w, damping = p.damping[0] * w;
  std::vector<Synchronous> result;
  for (double sign : {1.0, -1.0}) {
    // [r k - w^2 sign mu]^2 + (zeta w r)^2 = w^4 lambda^2.
    const double a = k * k + damping * damping, half_b = -k * w * w * sign * mu;
    const double c = w * w * w * w * (mu * mu - p.eccentricity * p.eccentricity);
    const double discriminant = half_b * half_b - a * c;
    if (discriminant < 0.0) continue;
    for (double branch : {1.0, -1.0}) {
      const double r = (-half_b + branch * std::sqrt(discriminant)) / a;
      if (!(r > 0.0)) continue;
      const double angle = -std::arg(Complex(r * k - w * w * sign * mu, damping * r));
      const Complex z = std::polar(r, angle), velocity = 1i * w * z;
      result.push_back(
          {r, {z.real(), z.imag(), velocity.real(), velocity.imag(), sign > 0 ? angle : angle + equipoise::pi, 0.0}});
    }
  }
  return result;
}

TEST(OneBall, IsAtRestAtTheClosedFormSynchronousStates) {
  model::Parameters p;
  p.balls = 1;
  p.drag[0] = 0.1;
  int found = 0;
  double largest = 0.0;
  for (double mu : {0.005, 0.0095, 0.012})
    for (double w : {0.7, 0.95, 1.2, 2.4}) {
      p.mass[0] = mu;
      for (const Synchronous& s : synchronous_states(p, w)) {
        ++found;
        const double rate = model::derivative(p, w, s.state).norm();
        largest = std::max(largest, rate);
        // Rounding of forces of size w^2 mu, and of the roots of the quadratic.
        EXPECT_LT(rate, 1e-14) << "mass " << mu << ", speed " << w;
      }
    }
  EXPECT_GE(found, 12);  // at least two for every speed while the ball is lighter than the unbalance
  RecordProperty("largest_rate", fmt::format("{:.2g}", largest));
}

TEST(OneBall, StaysAtAStableSynchronousState) {
  Study s;
  s.parameters.balls = 1;
  s.parameters.mass[0] = 0.008;
  s.parameters.drag[0] = 0.25;
  s.speed.speed = 0.8;  // below resonance the ball joins the heavy side
  int stable = 0;
  for (const Synchronous& state : synchronous_states(s.parameters, 0.8)) {
    const Eigen::VectorXcd values = equipoise::dense::eigenvalues(model::jacobian(s.parameters, 0.8, state.state));
    if (values.real().maxCoeff() >= 0.0) continue;
    ++stable;
    s.initial.x = state.state[0];
    s.initial.y = state.state[1];
    s.initial.phi[0] = state.state[4];
    const auto run = equipoise::simulate(s, {0.0, 50.0, 200.0});
    for (double r : run.radial) EXPECT_NEAR(r, state.r, 1e-12 * state.r);  // errors decay: rounding and tolerance only
    for (double phi : run.phi[0]) EXPECT_NEAR(phi, state.state[4], 1e-12);
  }
  EXPECT_EQ(stable, 1);
}

TEST(BalancedBalls, DoNotMoveAndHoldTheRotorCentred) {
  Study s;
  s.parameters.balls = 2;
  s.parameters.mass.fill(0.05);
  s.parameters.drag.fill(0.05);
  s.parameters.stiffness = {1.0, 1.4};  // supports do not matter while the rotor is centred
  s.speed.speed = 2.6;
  const double phi = std::acos(-0.1);
  s.initial.phi = {phi, -phi};
  const auto run = equipoise::simulate(s, {0.0, 10.0, 100.0});
  ASSERT_EQ(run.t.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(run.radial[k], 1e-14);  // rounding of the unbalance, 1e-17, times a modest response
    EXPECT_NEAR(run.phi[0][k], phi, 1e-12);
    EXPECT_NEAR(run.phi[1][k], -phi, 1e-12);
  }
}

}  // namespace steady_state_test
