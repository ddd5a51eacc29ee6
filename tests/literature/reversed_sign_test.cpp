// The code published with Mirkov and others (2026) has the ball's coupling to the rotor's acceleration with the wrong
// sign. Both systems, theirs by a switch that only this test has: the energy that it makes and the outcomes that it
// turns round. Own equations in SI units, after Lagrange, with that one sign open; only rates are compared with the
// program.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/study/contents/study.hpp"

namespace reversed_sign_test {

const char* const published_machine = EQUIPOISE_SOURCE_DIR "/studies/publications/mirkov-2026.toml";

enum class Coupling { right = 1, published = -1 };

// The defaults of the published code: two balls.
struct Machine {
  Coupling coupling = Coupling::right;
  double disc = 10.0, unbalance_mass = 0.05, eccentricity = 0.02, inertia = 0.05;
  double stiffness = 100.0, damping = 2.0;
  double ball = 0.03, race = 0.05, drag = 0.005;

  double mass() const { return disc + unbalance_mass + 2.0 * ball; }
  double unbalance() const { return unbalance_mass * eccentricity; }
};

// At a prescribed speed, along axes that turn with it: centre, its inertial velocity, angles and rates of the balls.
using Turning = Eigen::Matrix<double, 8, 1>;

Turning flow(const Machine& m, double w, const Turning& z) {
  const double mr = m.ball * m.race, sign = static_cast<double>(m.coupling);
  Eigen::Matrix4d inertia = Eigen::Matrix4d::Zero();
  Eigen::Vector4d force(m.unbalance() * w * w - m.damping * z[2] - m.stiffness * z[0],
                        -m.damping * z[3] - m.stiffness * z[1], 0.0, 0.0);
  inertia(0, 0) = inertia(1, 1) = m.mass();
  for (int i = 0; i < 2; ++i) {
    const double s = std::sin(z[4 + i]), c = std::cos(z[4 + i]), rate = w + z[6 + i];
    inertia(0, 2 + i) = -mr * s;
    inertia(1, 2 + i) = mr * c;
    inertia(2 + i, 0) = -sign * mr * s;
    inertia(2 + i, 1) = sign * mr * c;
    inertia(2 + i, 2 + i) = mr * m.race;
    force[0] += mr * rate * rate * c;
    force[1] += mr * rate * rate * s;
    force[2 + i] = -m.drag * z[6 + i];
  }
  const Eigen::Vector4d a = inertia.partialPivLu().solve(force);
  Turning dz;
  dz << z[2] + w * z[1], z[3] - w * z[0], a[0] + w * z[3], a[1] - w * z[2], z[6], z[7], a[2], a[3];
  return dz;
}

template <class State, class Flow>
State advanced(State z, double time, double step, const Flow& f) {
  const int steps = static_cast<int>(std::ceil(time / step));
  const double h = time / steps;
  for (int k = 0; k < steps; ++k) {
    const State a = f(z), b = f(z + 0.5 * h * a), c = f(z + 0.5 * h * b), d = f(z + h * c);
    z += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return z;
}

// Half the fast decay of a ball's rate, 67/s, and a fortieth of a turn.
constexpr double step = 0.0125;

double radius_um(const Turning& z) { return 1e6 * std::hypot(z[0], z[1]); }

Turning start(double first, double second) {
  Turning z = Turning::Zero();
  z[4] = first;
  z[5] = second;
  return z;
}

// Real parts, slowest first, by central differences.
std::vector<double> rates_at(const Machine& m, double w, const Turning& z) {
  Eigen::Matrix<double, 8, 8> jacobian;
  constexpr double h = 1e-6;
  for (int k = 0; k < 8; ++k) {
    const Turning d = h * Turning::Unit(k);
    jacobian.col(k) = (flow(m, w, z + d) - flow(m, w, z - d)) / (2.0 * h);
  }
  const Eigen::VectorXcd values = equipoise::dense::eigenvalues(jacobian);
  std::vector<double> real;
  for (const auto& v : values) real.push_back(v.real());
  std::sort(real.begin(), real.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); });
  return real;
}

// The balanced state: balls at pi -+ the angle whose cosine closes the polygon.
Turning balance(const Machine& m) {
  const double angle = std::acos(-m.unbalance() / (2.0 * m.ball * m.race));
  return start(angle, -angle);
}

// A rotor that turns freely, without dampers, drag or torque, in fixed axes: X, Y, psi, both balls' absolute angles,
// and their rates.
using Free = Eigen::Matrix<double, 10, 1>;

Free free_flow(const Machine& m, const Free& z) {
  const double mr = m.ball * m.race, u = m.unbalance(), sign = static_cast<double>(m.coupling);
  Eigen::Matrix<double, 5, 5> inertia = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 5, 1> force = Eigen::Matrix<double, 5, 1>::Zero();
  const double sp = std::sin(z[2]), cp = std::cos(z[2]);
  inertia(0, 0) = inertia(1, 1) = m.mass();
  inertia(0, 2) = inertia(2, 0) = -u * sp;
  inertia(1, 2) = inertia(2, 1) = u * cp;
  inertia(2, 2) = m.inertia + u * m.eccentricity;
  force[0] = -m.stiffness * z[0] + u * z[7] * z[7] * cp;
  force[1] = -m.stiffness * z[1] + u * z[7] * z[7] * sp;
  for (int i = 0; i < 2; ++i) {
    const double s = std::sin(z[3 + i]), c = std::cos(z[3 + i]), rate = z[8 + i];
    inertia(0, 3 + i) = -mr * s;
    inertia(1, 3 + i) = mr * c;
    inertia(3 + i, 0) = -sign * mr * s;
    inertia(3 + i, 1) = sign * mr * c;
    inertia(3 + i, 3 + i) = mr * m.race;
    force[0] += mr * rate * rate * c;
    force[1] += mr * rate * rate * s;
  }
  Free dz;
  dz << z.tail<5>(), inertia.partialPivLu().solve(force);
  return dz;
}

double energy(const Machine& m, const Free& z) {
  const double mr = m.ball * m.race, u = m.unbalance();
  const double along = -std::sin(z[2]) * z[5] + std::cos(z[2]) * z[6];
  double sum = 0.5 * m.mass() * (z[5] * z[5] + z[6] * z[6]) + u * z[7] * along +
               0.5 * (m.inertia + u * m.eccentricity) * z[7] * z[7] + 0.5 * m.stiffness * (z[0] * z[0] + z[1] * z[1]);
  for (int i = 0; i < 2; ++i)
    sum += 0.5 * mr * m.race * z[8 + i] * z[8 + i] +
           mr * z[8 + i] * (-std::sin(z[3 + i]) * z[5] + std::cos(z[3 + i]) * z[6]);
  return sum;
}

// (E - E0)/E0 after a time: the rotor lies still at x = 5 mm, the balls run at 5 and -3 rad/s from 0 and 2.5 rad.
double energy_made(Machine m, double time) {
  Free z = Free::Zero();
  z[0] = 0.005;
  z[4] = 2.5;
  z[8] = 5.0;
  z[9] = -3.0;
  const double before = energy(m, z);
  return energy(m, advanced(z, time, 1e-3, [&](const Free& at) { return free_flow(m, at); })) / before - 1.0;
}

TEST(ReversedSign, MakesEnergyThatNothingSupplies) {
  Machine m;
  // The error of four roundings a step, and of steps of 1e-3 s to the fourth power.
  for (const double time : {1.0, 10.0}) EXPECT_NEAR(energy_made(m, time), 0.0, 1e-10);
  m.coupling = Coupling::published;
  EXPECT_NEAR(energy_made(m, 1.0), 0.1215, 1e-4);
  EXPECT_NEAR(energy_made(m, 10.0), 0.1614, 1e-4);
  m.ball = 1.0;
  EXPECT_NEAR(energy_made(m, 1.0), 1.361, 1e-3);
  m.coupling = Coupling::right;
  EXPECT_NEAR(energy_made(m, 1.0), 0.0, 1e-10);
}

// What the mapping of symbols says: with the right sign these are the program's equations.
TEST(ReversedSign, IsAllThatDiffersFromTheProgram) {
  equipoise::Study study = equipoise::read_study(published_machine);
  study.initial.phi = {0.3, 2.5};
  const Machine m;
  const Turning z = advanced(start(0.3, 2.5), 5.0, 2e-4, [&](const Turning& at) { return flow(m, 12.0, at); });
  const equipoise::Trajectory ours = equipoise::simulate(study, {5.0 * study.scales->frequency});
  EXPECT_NEAR(ours.x.back() * m.race, z[0], 1e-12);
  EXPECT_NEAR(ours.y.back() * m.race, z[1], 1e-12);
  EXPECT_NEAR(ours.phi[0].back(), z[4], 1e-9);
  EXPECT_NEAR(ours.phi[1].back(), z[5], 1e-9);
}

TEST(ReversedSign, TurnsTheRatesNearBalanceRound) {
  constexpr double w = 12.0;
  Machine m;
  const Turning there = balance(m);
  EXPECT_LT(flow(m, w, there).norm(), 1e-10);
  const std::vector<double> right = rates_at(m, w, there);
  EXPECT_NEAR(right[0], -0.0015295, 5e-8);
  EXPECT_NEAR(right[1], -0.012233, 5e-7);
  m.coupling = Coupling::published;
  EXPECT_LT(flow(m, w, there).norm(), 1e-10);  // the same states are at rest
  const std::vector<double> published = rates_at(m, w, there);
  EXPECT_NEAR(published[0], 0.0015294, 5e-8);
  EXPECT_NEAR(published[1], 0.012229, 5e-7);
  // The program has the right ones.
  const equipoise::Study study = equipoise::read_study(published_machine);
  const equipoise::model::System system = study.system();
  const auto angles = equipoise::balanced_angles(equipoise::model::balanced_states(system), study.parameters);
  ASSERT_TRUE(angles);
  const auto rates = equipoise::balanced_rates(system, *angles, false);
  ASSERT_TRUE(rates);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(rates->rates[k].real() * study.scales->frequency, right[k], 2e-8);
}

// Six pairs of the sixty: all of them by 95 % of shares above 61 %.
TEST(ReversedSign, TurnsTheOutcomesRound) {
  constexpr double w = 12.0, horizon = 10000.0;  // fifteen of the slowest time constants
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  Machine right, published;
  published.coupling = Coupling::published;
  for (int k = 0; k < 6; ++k) {
    const Turning z = start(angle(generator), angle(generator));
    const Turning balanced = advanced(z, horizon, step, [&](const Turning& at) { return flow(right, w, at); });
    EXPECT_LT(radius_um(balanced), 0.2) << k;
    const Turning heavy = advanced(z, horizon, step, [&](const Turning& at) { return flow(published, w, at); });
    EXPECT_NEAR(radius_um(heavy), 424.56, 0.005) << k;
    for (int i = 4; i < 6; ++i)
      EXPECT_NEAR(std::fabs(std::remainder(heavy[i], 2.0 * std::numbers::pi)) * 180.0 / std::numbers::pi, 4.06, 0.005);
    // Where theirs ends, the true system is at rest too, and leaves: their attractor repels.
    EXPECT_LT(flow(right, w, heavy).norm(), 1e-6);
    const std::vector<double> there = rates_at(right, w, heavy), theirs = rates_at(published, w, heavy);
    EXPECT_NEAR(there[0], 0.004581, 5e-7);
    EXPECT_NEAR(there[1], 0.018336, 5e-7);
    EXPECT_NEAR(theirs[0], -0.004581, 5e-7);
    EXPECT_NEAR(theirs[1], -0.018346, 5e-7);
  }
}

// Below the critical speed, at 3 rad/s, it is the other way round: theirs balances.
TEST(ReversedSign, TurnsTheRatesRoundBelowTheCriticalSpeedToo) {
  Machine m;
  const Turning there = balance(m);
  EXPECT_GT(rates_at(m, 3.0, there).front(), 1e-5);
  m.coupling = Coupling::published;
  EXPECT_LT(rates_at(m, 3.0, there).front(), -1e-5);
}

}  // namespace reversed_sign_test
