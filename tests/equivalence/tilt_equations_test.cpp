// The equations of a tilting rotor against a second formulation: Lagrange's equations in fixed axes, solved with
// their full mass matrix, on random rotors, balls, planes and states; at prescribed motions and under motors.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/random.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/drives/full_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/machine/model/system.hpp"
#include "tilt_fixed_axes.hpp"

namespace tilt_equations_test {

namespace model = equipoise::model;
using namespace equipoise::tilting;
using Eigen::VectorXd;

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) { return low + (high - low) * random_.uniform(); }

  model::Parameters rotor(bool gravity, bool isotropic) {
    model::Parameters p;
    p.balls = 1 + static_cast<int>(between(0.0, 6.0));
    p.eccentricity = between(0.0, 0.2);
    p.eccentricity_angle = between(-3.0, 3.0);
    p.inertia = between(0.5, 1.0);
    if (gravity) p.gravity = between(0.0, 0.5);
    p.tilt.transverse_inertia = between(0.3, 4.0);
    p.tilt.polar_inertia = between(0.0, 2.0 * p.tilt.transverse_inertia);
    p.tilt.misalignment = between(-0.1, 0.1);
    for (const std::size_t d : {0, 1}) {
      const bool as_x = isotropic && d == 1;
      p.damping[d] = as_x ? p.damping[0] : between(0.0, 1.0);
      p.stiffness[d] = as_x ? p.stiffness[0] : between(0.5, 2.0);
      p.tilt.damping[d] = as_x ? p.tilt.damping[0] : std::array{between(-0.2, 0.2), between(0.2, 1.0)};
      p.tilt.stiffness[d] = as_x ? p.tilt.stiffness[0] : std::array{between(-0.5, 0.5), between(1.0, 9.0)};
    }
    for (int i = 0; i < p.balls; ++i) {
      p.mass[i] = between(0.01, 0.2);
      p.drag[i] = between(0.0, 0.5);
      p.tilt.plane[i] = between(-3.0, 3.0);
    }
    return p;
  }

  VectorXd state(const model::System& system) {
    VectorXd y(system.dimension());
    for (double& v : y) v = between(-1.0, 1.0);
    for (int i = 0; i < system.balls(); ++i) y[model::index::phi(i)] = between(-3.0, 3.0);
    return y;
  }

 private:
  equipoise::RandomStream random_;
};

// The largest difference between both, relative to the largest acceleration.
double disagreement(const model::System& system, const VectorXd& y, double psi) {
  const model::Parameters& p = system.parameters();
  const int n = p.balls, t = system.layout().tilt;
  if (system.layout().psi >= 0) psi = y[system.layout().psi];
  if (!system.prescribed() && system.layout().psi < 0) psi = 0.0;  // nothing depends on it
  const double w = system.speed(y), torque = system.torque(y);
  const Fixed f = fixed_of(p, system, y, psi, w);
  const VectorXd there = accelerations(p, f, system.prescribed() ? nullptr : &torque, system.drive().acceleration);
  const VectorXd here = model::rate(system, y, psi);
  const Complex turn = std::polar(1.0, psi);
  const Complex a = (Complex(here[2], here[3]) + i1 * w * Complex(y[2], y[3])) * turn,
                b = (Complex(here[t + 2], here[t + 3]) + i1 * w * Complex(y[t + 2], y[t + 3])) * turn;
  double worst = std::max(std::abs(a - Complex(there[0], there[1])), std::abs(b - Complex(there[2], there[3])));
  const double spin = there[4 + n];
  for (int i = 0; i < n; ++i) worst = std::max(worst, std::fabs(here[4 + n + i] + spin - there[4 + i]));
  if (!system.prescribed()) worst = std::max(worst, std::fabs(here[system.layout().speed] - spin));
  const Complex moved = Complex(y[t + 2], y[t + 3]) - i1 * w * Complex(y[t], y[t + 1]);
  worst = std::max(worst, std::abs(moved - Complex(here[t], here[t + 1])));
  return worst / there.lpNorm<Eigen::Infinity>();
}

constexpr int trials = 200;
// Both solve systems of up to eleven equations, with condition numbers of some hundreds.
constexpr double rounding = 1e-11;

TEST(TiltEquations, AreThoseOfLagrangeAtAPrescribedMotion) {
  for (int k = 0; k < trials; ++k) {
    Draws draws(1000 + static_cast<std::uint64_t>(k));
    const model::Parameters p = draws.rotor(k % 2 == 0, k % 3 == 0);
    const model::DrivePiece piece{.prescribed = true,
                                  .speed = draws.between(-4.0, 4.0),
                                  .acceleration = k % 4 == 0 ? 0.0 : draws.between(-1.0, 1.0)};
    const model::System system(p, piece);
    EXPECT_LT(disagreement(system, draws.state(system), draws.between(-3.0, 3.0)), rounding) << k;
  }
}

TEST(TiltEquations, AreThoseOfLagrangeUnderAMotor) {
  for (int k = 0; k < trials; ++k) {
    Draws draws(5000 + static_cast<std::uint64_t>(k));
    const model::Parameters p = draws.rotor(k % 2 == 0, k % 3 == 0);
    model::DrivePiece piece{.prescribed = false};
    piece.motor.constant = draws.between(-1.0, 1.0);
    piece.motor.slope = draws.between(-1.0, 0.0);
    const model::System system(p, piece);
    ASSERT_EQ(system.dimension(), model::dimension(p.balls) + (system.autonomous() ? 5 : 6));
    EXPECT_LT(disagreement(system, draws.state(system), 0.0), rounding) << k;
  }
}

// Kinetic and potential energy without the gyroscopic moment, which does no work.
double energy(const model::Parameters& p, const Fixed& f) {
  const Complex turn = std::polar(1.0, f.psi), unbalance = std::polar(p.eccentricity, f.psi + p.eccentricity_angle);
  const double couple = p.tilt.misalignment * (p.tilt.transverse_inertia - p.tilt.polar_inertia);
  double e = 0.5 * std::norm(f.v1 + i1 * f.w * unbalance) + 0.5 * p.tilt.transverse_inertia * std::norm(f.v2) +
             f.w * couple * (std::conj(f.v2) * i1 * turn).real() + 0.5 * p.inertia * f.w * f.w;
  for (int i = 0; i < p.balls; ++i)
    e += 0.5 * p.mass[i] * std::norm(f.v1 + p.tilt.plane[i] * f.v2 + i1 * f.rate[i] * std::polar(1.0, f.theta[i]));
  for (const int d : {0, 1}) {
    const double x = d ? f.q1.imag() : f.q1.real(), s = d ? f.q2.imag() : f.q2.real();
    const auto& k = p.tilt.stiffness[static_cast<std::size_t>(d)];
    e += 0.5 * p.stiffness[static_cast<std::size_t>(d)] * x * x + k[0] * x * s + 0.5 * k[1] * s * s;
  }
  return e;
}

TEST(TiltEquations, KeepTheBalanceOfEnergyUnderAMotor) {
  constexpr double step = 1e-4;
  for (int k = 0; k < trials; ++k) {
    Draws draws(9000 + static_cast<std::uint64_t>(k));
    const model::Parameters p = draws.rotor(false, false);
    model::DrivePiece piece{.prescribed = false};
    piece.motor.constant = draws.between(-1.0, 1.0);
    const model::System system(p, piece);
    const VectorXd y = draws.state(system);
    const auto fixed = [&](const VectorXd& at) {
      return fixed_of(p, system, at, at[system.layout().psi], at[system.layout().speed]);
    };
    // By a fourth-order difference along one step of Runge and Kutta either way.
    const auto after = [&](double h) {
      const VectorXd k1 = model::rate(system, y), k2 = model::rate(system, VectorXd(y + 0.5 * h * k1)),
                     k3 = model::rate(system, VectorXd(y + 0.5 * h * k2)),
                     k4 = model::rate(system, VectorXd(y + h * k3));
      return energy(p, fixed(y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)));
    };
    const double growth = (8.0 * (after(step) - after(-step)) - after(2.0 * step) + after(-2.0 * step)) / (12.0 * step);
    const Fixed f = fixed(y);
    double power = system.torque(y) * f.w;
    for (const int d : {0, 1}) {
      const double x = d ? f.v1.imag() : f.v1.real(), s = d ? f.v2.imag() : f.v2.real();
      const auto& c = p.tilt.damping[static_cast<std::size_t>(d)];
      power -= p.damping[static_cast<std::size_t>(d)] * x * x + 2.0 * c[0] * x * s + c[1] * s * s;
    }
    for (int i = 0; i < p.balls; ++i) power -= p.mass[i] * p.drag[i] * std::pow(f.rate[i] - f.w, 2);
    EXPECT_NEAR(growth, power, 1e-9 * (1.0 + std::fabs(power))) << k;
  }
}

// Two planes at +z and -z whose balls stand alike, without couple unbalance or coupled supports: the shaft stays
// straight, and its centre moves as a plane rotor's with balls of twice the mass.
TEST(TiltEquations, ReduceToThePlaneRotor) {
  for (int k = 0; k < trials; ++k) {
    Draws draws(20000 + static_cast<std::uint64_t>(k));
    model::Parameters p = draws.rotor(false, false), plane;
    const int half = std::max(p.balls / 2, 1);
    p.balls = 2 * half;
    p.eccentricity_angle = p.tilt.misalignment = 0.0;
    plane.balls = half;
    plane.eccentricity = p.eccentricity;
    plane.damping = p.damping;
    plane.stiffness = p.stiffness;
    const double z = draws.between(0.5, 3.0);
    for (const std::size_t d : {0, 1}) p.tilt.stiffness[d][0] = p.tilt.damping[d][0] = 0.0;
    for (int i = 0; i < half; ++i) {
      p.mass[i] = p.mass[half + i] = draws.between(0.01, 0.2);
      p.drag[i] = p.drag[half + i] = draws.between(0.0, 0.5);
      plane.mass[i] = 2.0 * p.mass[i];
      plane.drag[i] = p.drag[i];
      p.tilt.plane[i] = z;
      p.tilt.plane[half + i] = -z;
    }
    const double speed = draws.between(0.5, 4.0), psi = draws.between(-3.0, 3.0);
    const model::System tilting(p, speed), flat(plane, speed);
    const VectorXd y = draws.state(flat);
    VectorXd both = VectorXd::Zero(tilting.dimension());
    both.head(4) = y.head(4);
    for (int i = 0; i < half; ++i)
      for (const int j : {i, half + i}) {
        both[4 + j] = y[4 + i];
        both[4 + p.balls + j] = y[4 + half + i];
      }
    const VectorXd there = model::rate(flat, y, psi), here = model::rate(tilting, both, psi);
    constexpr double few_roundings = 1e-14;
    const double within = few_roundings * there.lpNorm<Eigen::Infinity>();
    EXPECT_LT((here.head(4) - there.head(4)).lpNorm<Eigen::Infinity>(), within);
    EXPECT_LT(here.tail(4).lpNorm<Eigen::Infinity>(), within);
    for (int i = 0; i < half; ++i)
      for (const int j : {i, half + i}) EXPECT_NEAR(here[4 + p.balls + j], there[4 + half + i], within);
  }
}

// "Long rotor" of Rodrigues and others (2008, 2011).
model::Parameters long_rotor(double eccentricity, double chi, double angle, double mass, double drag) {
  model::Parameters p;
  p.balls = 4;
  p.eccentricity = eccentricity;
  p.eccentricity_angle = angle;
  p.damping = {0.02, 0.02};
  p.tilt.transverse_inertia = 3.25;
  p.tilt.polar_inertia = 0.5;
  p.tilt.misalignment = chi;
  p.tilt.stiffness = {{{0.0, 9.0}, {0.0, 9.0}}};
  p.tilt.damping = {{{0.0, 0.18}, {0.0, 0.18}}};
  for (int i = 0; i < 4; ++i) {
    p.mass[i] = mass;
    p.drag[i] = drag;
    p.tilt.plane[i] = i < 2 ? 2.0 : -2.0;
  }
  return p;
}

double growth_of_balance(const model::Parameters& p, double speed) {
  const model::System system(p, speed);
  const model::BalancedStates states = model::balanced_states(system);
  EXPECT_EQ(states.kind, model::BalancedStates::Kind::isolated);
  const VectorXd y = model::balanced_state(system, speed, states.angles.front().data());
  return equipoise::dense::largest_real_part(model::jacobian(system, y));
}

// Boundaries of stability to eight digits, found with matrices of their own (Rodrigues and others 2011, model of linear
// tilt; figure 14 c prints 3.387 for the fourth).
TEST(TiltEquations, BalanceIsLostWhereItWasPublished) {
  struct Boundary {
    double eccentricity, chi, angle, mass, drag, speed;
  };
  for (const Boundary& b :
       {Boundary{0.01, 0.0, 0.0, 0.005, 0.01, 2.9334208}, Boundary{0.01, 0.0, 0.0, 0.025, 0.01, 4.4795187},
        Boundary{0.01, 0.0, 0.0, 0.04, 0.01, 5.2624785}, Boundary{0.005, 0.005, 1.0, 0.01, 0.01, 3.3869559},
        Boundary{0.005, 0.005, 1.0, 0.01, 0.1, 3.0172581}, Boundary{0.01, 0.0, 0.0, 0.01, 0.01, 3.5034890},
        Boundary{5e-5, 5e-5, 1.0, 1e-4, 0.01, 2.0977224}}) {
    const model::Parameters p = long_rotor(b.eccentricity, b.chi, b.angle, b.mass, b.drag);
    EXPECT_GT(growth_of_balance(p, b.speed - 2e-7), 0.0) << b.speed;
    EXPECT_LT(growth_of_balance(p, b.speed + 2e-7), 0.0) << b.speed;
  }
}

// Figure 12 of Rodrigues and others (2008).
TEST(TiltEquations, TwoPlanesCloseTheirPolygons) {
  const model::Parameters p = long_rotor(0.005, 0.005, 1.0, 0.005, 0.01);
  const model::BalancedStates states = model::balanced_states(p);
  ASSERT_EQ(states.kind, model::BalancedStates::Kind::isolated);
  ASSERT_EQ(states.angles.size(), 4u);
  const std::array<double, 4> published{-1.70721, 2.53512, 0.48053, 4.22378};
  const auto is_it = [&](const auto& phi) {
    bool same = true;
    for (std::size_t i = 0; i < 4; ++i) same = same && std::fabs(equipoise::wrapped(phi[i] - published[i])) < 1e-5;
    return same;
  };
  EXPECT_EQ(std::count_if(states.angles.begin(), states.angles.end(), is_it), 1);
}

}  // namespace tilt_equations_test
