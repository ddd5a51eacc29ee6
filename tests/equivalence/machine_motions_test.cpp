// Steady motions of motors, off-centre races and both where the rotor's angle matters, against closed forms, energy
// balances by other quadratures, differences of whole trajectories, and prescribed rotors as their limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {
namespace machine_motions_test {

using Eigen::VectorXd;
using model::System;

// lambda = 0.01, zeta = 0.5
model::Parameters rotor(int balls = 2, double mass = 0.05) {
  model::Parameters p;
  p.balls = balls;
  p.inertia = 0.5;
  p.mass.fill(mass);
  p.drag.fill(0.05);
  return p;
}
model::Parameters under_gravity(model::Parameters p) {
  p.gravity = 0.01;
  return p;
}
model::Parameters off_centre(model::Parameters p) {
  p.race_offset = {0.005, 0.002};
  return p;
}

// Torque constant + slope psi'.
model::DrivePiece motor(double constant, double slope) {
  model::DrivePiece piece;
  piece.prescribed = false;
  piece.motor.constant = constant;
  piece.motor.slope = slope;
  return piece;
}
// Supplies no torque at `speed`.
model::DrivePiece motor_for(double speed, double gain) { return motor(gain * speed, -gain); }

VectorXd at_rest(const System& system, std::vector<double> angles, double speed) {
  VectorXd y = VectorXd::Zero(system.dimension());
  for (int i = 0; i < system.balls(); ++i) y[model::index::phi(i)] = angles[i];
  if (system.layout().speed >= 0) y[system.layout().speed] = speed;
  return y;
}

std::string name_of(const System& system, const Motion& motion) {
  return motion_name(system.parameters(), motion).name;
}

// The first motion of that name from a fixed sequence of random starts at `speed`.
std::optional<Motion> find(const System& system, const std::string& name, double speed) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(0.0, two_pi);
  for (int start = 0; start < 40; ++start) {
    std::vector<double> angles(system.balls());
    for (double& phi : angles) phi = angle(random);
    const auto motion = motion_from(system, at_rest(system, angles, speed));
    if (motion && name_of(system, *motion) == name) return motion;
  }
  return std::nullopt;
}

// The largest modulus of a multiplier, except that of the shift in time.
double largest(const Motion& motion) { return std::abs(motion.orbit.decays()[0]); }

// A motor of infinite power is a prescribed speed: with gain g all differences fall as 1/g.
TEST(MachineMotions, AStrongMotorTendsToThePrescribedSpeed) {
  for (const model::Parameters& p : {rotor(), off_centre(rotor())}) {
    const System prescribed(p, 2.4);
    const auto limit = motion_from(prescribed, at_rest(prescribed, {1.0, 1.0}, 2.4));
    ASSERT_TRUE(limit);
    ASSERT_EQ(name_of(prescribed, *limit), "co-drifting");
    double before = 0.0;
    for (const double gain : {10.0, 100.0, 1000.0}) {
      const System system(p, motor_for(2.4, gain));
      const auto motion = motion_from(system, at_rest(system, {1.0, 1.0}, 2.4));
      ASSERT_TRUE(motion);
      EXPECT_EQ(name_of(system, *motion), "co-drifting");
      EXPECT_EQ(motion_name(p, *motion).id, 2);
      EXPECT_EQ(motion->kind, MotionKind::periodic);
      const double away =
          std::max({std::fabs(motion->r_mean - limit->r_mean), std::fabs(motion->drift[0] - limit->drift[0]),
                    std::fabs(largest(*motion) - largest(*limit)), std::fabs(motion->speed - 2.4)});
      EXPECT_LT(away, 0.05 / gain);  // torque 0.008 over the gain in speed, a few times that in the rest
      // A tenth, up to terms of the next order.
      if (before > 0.0) {
        EXPECT_NEAR(before / away, 10.0, 1.0) << gain;
      }
      before = away;
    }
  }
}

TEST(MachineMotions, AStrongMotorTendsToThePrescribedSpeedUnderGravityToo) {
  for (const model::Parameters& p : {under_gravity(rotor()), off_centre(under_gravity(rotor()))}) {
    const System prescribed(p, 2.4);
    model::Parameters level = p;
    level.gravity = 0.0;
    const auto angles = model::balanced_states(System(level, 2.4)).angles.front();
    const auto limit = balanced_orbit(prescribed, angles.data());
    ASSERT_TRUE(limit);
    const Motion at_speed = describe_orbit(prescribed, *limit);
    EXPECT_TRUE(at_speed.balanced);
    for (const double gain : {100.0, 1000.0}) {
      const System system(p, motor_for(2.4, gain));
      const auto orbit = balanced_orbit(system, angles.data());
      ASSERT_TRUE(orbit);
      const Motion motion = describe_orbit(system, *orbit);
      EXPECT_TRUE(motion.balanced);
      EXPECT_TRUE(motion.depends_on_angle);
      EXPECT_EQ(motion.sections, 1);
      EXPECT_EQ(name_of(system, motion), "balanced");
      // The motor supplies 3e-5, and the speed varies by less than that over the gain.
      EXPECT_NEAR(motion.r_max, at_speed.r_max, 1e-3 / gain);
      EXPECT_NEAR(motion.period, at_speed.period, 1e-3 / gain);
      EXPECT_NEAR(largest(motion), largest(at_speed), 0.1 / gain);
    }
  }
}

// The motor's mean power over a period is what dampers and drag dissipate. This is summed along the orbit by another
// quadrature (equal steps over a whole period converge faster than any power), from positions and rates alone.
TEST(MachineMotions, TheMotorGivesWhatDampersAndDragTake) {
  struct Case {
    model::Parameters p;
    model::DrivePiece drive;
    std::string name;
    double start;
  };
  model::Parameters light = rotor(2, 0.02);
  light.eccentricity = 0.02;
  light.damping = {0.1, 0.1};
  for (const Case& c :
       {Case{rotor(), motor_for(3.0, 0.1), "co-drifting", 2.0}, Case{light, motor_for(3.0, 0.001), "one captured", 0.0},
        Case{under_gravity(rotor()), motor_for(3.0, 0.1), "balanced", 3.0},
        Case{off_centre(under_gravity(rotor())), motor_for(3.0, 0.01), "balanced", 3.0}}) {
    const System system(c.p, c.drive);
    const auto motion = find(system, c.name, c.start);
    ASSERT_TRUE(motion) << c.name;
    ASSERT_EQ(motion->kind, MotionKind::periodic);
    ASSERT_TRUE(motion->motor);
    const int n = system.balls(), count = 256;
    double supports = 0.0, drag = 0.0, torque = 0.0, speed = 0.0;
    for (const VectorXd& y : sample_orbit(system, motion->orbit, count)) {
      supports += c.p.damping[0] * y.segment(2, 2).squaredNorm() / count;
      for (int i = 0; i < n; ++i) drag += c.p.mass[i] * c.p.drag[i] * std::pow(y[model::index::q(i, n)], 2) / count;
      torque += (c.drive.motor.constant + c.drive.motor.slope * system.speed(y)) / count;
      speed += system.speed(y) / count;
    }
    // Statistics use Simpson's rule over parts of 0.07: (0.07 rate)^4 / 180 of an amplitude.
    EXPECT_NEAR(motion->motor->power, supports + drag, 1e-6 * (supports + drag)) << c.name;
    EXPECT_NEAR(motion->motor->support_power, supports, 1e-6 * supports) << c.name;
    EXPECT_NEAR(motion->motor->torque, torque, 1e-6 * torque) << c.name;
    EXPECT_NEAR(motion->speed, speed, 1e-9) << c.name;
    EXPECT_LE(motion->motor->speed_min, motion->speed);
    EXPECT_GE(motion->motor->speed_max, motion->speed);
  }
}

// Sommerfeld's effect: started from rest the rotor hangs at resonance, started fast it runs. Both are equilibria, with
// the balls where they make the unbalance worse or better. r follows from a rigid rotor, and the torque from the
// dampers' work.
TEST(MachineMotions, AWeakMotorIsCapturedAtResonance) {
  model::Parameters p = rotor(2, 0.01);
  p.eccentricity = 0.05;
  p.damping = {0.1, 0.1};
  const System system(p, motor_for(3.0, 0.005));
  const auto captured = motion_from(system, at_rest(system, {0.5, 2.0}, 0.0)),
             running = motion_from(system, at_rest(system, {0.5, 2.0}, 3.0));
  ASSERT_TRUE(captured && running);
  EXPECT_EQ(name_of(system, *captured), "locked, captured at resonance");
  EXPECT_EQ(motion_name(p, *captured).id, 0);
  EXPECT_EQ(name_of(system, *running), "locked");
  EXPECT_FALSE(same_motion(p, *captured, *running));
  EXPECT_TRUE(same_motion(p, *captured, *motion_from(system, at_rest(system, {3.0, 1.0}, 0.2))));
  EXPECT_NEAR(captured->speed, 1.0 / std::sqrt(1.02), 0.1);
  for (const Motion* motion : {&*captured, &*running}) {
    EXPECT_TRUE(motion->stable);
    const double w = motion->speed, mass = 1.02;
    std::complex<double> unbalance = p.eccentricity;
    for (int i = 0; i < 2; ++i) unbalance += p.mass[i] * std::polar(1.0, motion->state[model::index::phi(i)]);
    const double r = std::abs(unbalance) * w * w / std::hypot(1.0 - mass * w * w, 0.1 * w);
    // Newton's method leaves 1e-14 of forces; resonance magnifies them tenfold.
    EXPECT_NEAR(motion->r_mean, r, 1e-12);
    EXPECT_NEAR(motion->motor->torque, 0.1 * w * r * r, 1e-12);
    EXPECT_NEAR(motion->motor->torque, 0.005 * (3.0 - w), 1e-15);
    EXPECT_NEAR(motion->motor->power, motion->motor->support_power, 1e-12);
  }
}

// Gravity holds an unbalance that the motor cannot lift: torque over lever arm is the sine of the angle.
TEST(MachineMotions, ARotorThatCannotLiftItsUnbalanceIsStalled) {
  model::Parameters p = rotor(2, 0.01);
  p.eccentricity = 0.05;
  p.damping = {0.1, 0.1};
  p.gravity = 0.2;
  const System system(p, motor_for(3.0, 0.002));
  const auto motion = motion_from(system, at_rest(system, {0.5, 2.0}, 0.0));
  ASSERT_TRUE(motion);
  EXPECT_EQ(name_of(system, *motion), "stalled");
  EXPECT_TRUE(motion->stable);
  EXPECT_EQ(motion->kind, MotionKind::equilibrium);
  const double psi = motion->state[system.layout().psi];
  EXPECT_NEAR(std::cos(psi) * p.eccentricity * p.gravity, 0.006, 1e-14);
  for (int i = 0; i < 2; ++i)  // balls at the bottom
    EXPECT_NEAR(wrapped(psi + motion->state[model::index::phi(i)] + 0.5 * pi), 0.0, 1e-12);
  EXPECT_NEAR(motion->r_mean, 0.0, 1e-14);
}

TEST(MachineMotions, WhatHasNoSteadyMotionHasNone) {
  const System away(rotor(), motor(0.3, 0.0));  // strong enough to leave all resonances behind
  EXPECT_FALSE(motion_from(away, at_rest(away, {0.3, 3.0}, 2.7)));
  EXPECT_TRUE(away.runs_away(31.0));
  EXPECT_FALSE(System(rotor(), motor_for(3.0, 0.1)).runs_away(31.0));
}

// Without torque a rotor balances at any speed: a continuum, and one motion.
TEST(MachineMotions, ARotorWithoutTorqueBalancesAtAnySpeed) {
  const System system(rotor(), motor(0.0, 0.0));
  const auto fast = motion_from(system, at_rest(system, {1.5, 4.6}, 2.7)),
             slow = motion_from(system, at_rest(system, {1.5, 4.6}, 2.5));
  ASSERT_TRUE(fast && slow);
  EXPECT_EQ(name_of(system, *fast), "balanced");
  EXPECT_EQ(name_of(system, *slow), "balanced");
  EXPECT_GT(fast->speed - slow->speed, 0.1);
  EXPECT_TRUE(fast->stable);
  EXPECT_NEAR(fast->exponents[0], 0.0, 1e-12);
  EXPECT_LT(fast->exponents[1], -1e-3);
  EXPECT_TRUE(same_motion(rotor(), *fast, *slow));
}

TEST(MachineMotions, MirrorImagesRunBackwardsAlike) {
  const System forwards(off_centre(rotor()), motor_for(3.0, 0.1));
  model::Parameters p = off_centre(rotor());
  p.race_offset[1] = -p.race_offset[1];
  const System mirrored(p, motor_for(-3.0, 0.1));
  for (const std::vector<double>& angles : {std::vector{1.0, 1.1}, std::vector{1.5, 4.5}}) {
    const auto one = motion_from(forwards, at_rest(forwards, angles, 2.0)),
               other = motion_from(mirrored, at_rest(mirrored, {-angles[0], -angles[1]}, -2.0));
    ASSERT_TRUE(one && other);
    EXPECT_EQ(name_of(forwards, *one), name_of(mirrored, *other));
    EXPECT_NEAR(one->speed, -other->speed, 1e-9);
    EXPECT_NEAR(one->r_max, other->r_max, 1e-9);
    EXPECT_NEAR(one->motor->power, other->motor->power, 1e-9);
  }
  // Started in the other sense, the motor turns it back.
  const auto turned = motion_from(forwards, at_rest(forwards, {1.5, 4.5}, -1.0));
  ASSERT_TRUE(turned);
  EXPECT_GT(turned->speed, 0.0);
}

// In an off-centre race balls rest where they bring the race's own centre to the axis; three and more do so on a
// continuum.
TEST(MachineMotions, AnOffCentreRaceIsBalancedWithItsOwnCentreOnTheAxis) {
  for (const bool driven : {false, true})
    for (const int balls : {2, 3, 4}) {
      model::Parameters p = off_centre(rotor(balls, balls == 2 ? 0.05 : 0.03));
      if (balls > 2) p.drag.fill(0.25);  // with less most of the continuum is unstable
      const System system = driven ? System(p, motor_for(3.0, 0.05)) : System(p, 3.0);
      const auto speed = model::balanced_speed(system);
      ASSERT_TRUE(speed);
      const double e = std::hypot(0.005, 0.002);
      // The motor supplies what the dampers absorb from a rotor that whirls at e.
      if (driven) {
        EXPECT_NEAR(0.05 * (3.0 - *speed), 0.5 * e * e * *speed, 1e-15);
      }
      const auto motion = find(system, "balanced", 2.8);
      ASSERT_TRUE(motion) << balls;
      EXPECT_EQ(motion->kind, MotionKind::equilibrium);
      EXPECT_TRUE(motion->stable);
      EXPECT_NEAR(motion->state[0], -0.005, 1e-13);
      EXPECT_NEAR(motion->state[1], -0.002, 1e-13);
      EXPECT_NEAR(motion->speed, *speed, 1e-12);
      EXPECT_LT(model::rate(system, motion->state).cwiseAbs().maxCoeff(), 1e-13);
      EXPECT_EQ(model::balanced_freedom(system), balls - 2);
      for (int k = 0; k < balls - 2; ++k) EXPECT_NEAR(std::abs(motion->exponents[k]), 0.0, 1e-10);
      EXPECT_LT(motion->exponents[balls - 2], -1e-3);
      EXPECT_EQ(motion->copies, balls == 2 ? 2 : 1);
    }
}

// Switching on the offset gradually turns the centred race's balanced states into the closed form.
TEST(MachineMotions, BalanceOfAnOffCentreRaceIsContinuousInTheOffset) {
  model::Parameters p = rotor();
  VectorXd state = model::centred_state(p, model::balanced_states(p).angles.front().data());
  for (int k = 1; k <= 20; ++k) {
    p.race_offset = {0.005 * k / 20, 0.002 * k / 20};
    const auto next = refine_equilibrium(System(p, 2.4), state);
    ASSERT_TRUE(next);
    EXPECT_LT((next->state - state).cwiseAbs().maxCoeff(), 0.02);
    state = next->state;
  }
  const System system(p, 2.4);
  const auto angles = model::balanced_states(system).angles.front();
  // Twenty Newton refinements to rounding of forces, over the least curvature (0.03).
  EXPECT_LT((model::balanced_state(system, 2.4, angles.data()) - state).cwiseAbs().maxCoeff(), 1e-11);
}

// Multipliers of orbits, and exponentials of eigenvalues, agree with differences of whole trajectories.
TEST(MachineMotions, MultipliersAreThoseOfDifferences) {
  for (const System& system :
       {System(rotor(), motor_for(3.0, 0.1)), System(under_gravity(rotor()), motor_for(3.0, 0.1)),
        System(off_centre(under_gravity(rotor())), motor_for(3.0, 0.01)), System(off_centre(rotor()), 2.4)}) {
    const auto motion = motion_from(system, at_rest(system, {1.4, 4.4}, 2.9));
    ASSERT_TRUE(motion);
    const double period = motion->period > 0.0 ? motion->period : 2.0, step = 1e-5;
    const int size = system.dimension();
    const VectorXd start = motion->period > 0.0 ? motion->orbit.nodes.front() : motion->state;
    Eigen::MatrixXd map(size, size);
    for (int k = 0; k < size; ++k) {
      VectorXd up = start, down = start;
      up[k] += step;
      down[k] -= step;
      map.col(k) = (*advance_state(system, up, period) - *advance_state(system, down, period)) / (2.0 * step);
    }
    Eigen::VectorXcd expected = motion->spectrum;
    if (motion->period == 0.0) expected = (motion->spectrum * period).array().exp();
    const Eigen::VectorXcd found = equipoise::dense::eigenvalues(map);
    for (const auto& value : expected) {
      double nearest = 1e300;
      for (const auto& other : found) nearest = std::min(nearest, std::abs(other - value));
      // Differences err by step^2 times third derivatives and by 1e-12 / step; nearly coincident pairs by the root of
      // that.
      EXPECT_LT(nearest, 1e-5) << value;
    }
  }
}

// The equations of machines, with pieces and events, return a motion's state.
TEST(MachineMotions, OrbitsCloseUnderSimulate) {
  Study study = parse_study(R"([rotor]
eccentricity = 0.01
damping = 0.5
inertia = 0.5
gravity = 0.01
[balancer]
balls = 2
mass = 0.05
drag = 0.05
race_offset = [0.005, 0.002]
[speed]
profile = "torque"
initial = 3.0
torque = { constant = 0.3, slope = -0.1 }
[release]
time = 0.0
)",
                            "closure", {});
  const System system = study.system();
  const auto motion = find(system, "balanced", 3.0);
  ASSERT_TRUE(motion);
  const VectorXd& y = motion->orbit.nodes.front();
  const double w = system.speed(y);
  study.speed.initial = w;
  study.initial.psi = y[system.layout().psi];
  study.initial.x = y[0];
  study.initial.y = y[1];
  study.initial.x_dot = y[2] + w * y[1];
  study.initial.y_dot = y[3] - w * y[0];
  for (int i = 0; i < 2; ++i) {
    study.initial.phi[i] = y[model::index::phi(i)];
    study.initial.phi_dot[i] = y[model::index::q(i, 2)];
  }
  const Trajectory path = simulate(study, {0.0, motion->period});
  // The residual of Newton's method, and what simulate() adds over a revolution.
  EXPECT_NEAR(path.x.back(), y[0], 1e-9);
  EXPECT_NEAR(path.y.back(), y[1], 1e-9);
  EXPECT_NEAR(path.psi_dot.back(), w, 1e-9);
  EXPECT_NEAR(path.psi.back() - study.initial.psi, two_pi, 1e-9);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(path.phi[i].back(), y[model::index::phi(i)], 1e-9);
}

// Names do not change under negligible gravity; only drifting motions are modulated.
TEST(MachineMotions, BalanceAndLockedMotionsKeepTheirNamesUnderALittleGravity) {
  model::Parameters p = rotor(), weak = rotor();
  weak.gravity = 1e-6;
  weak.stiffness = {1.0, 1.0 + 1e-6};
  const System level(p, motor_for(3.0, 0.1)), tilted(weak, motor_for(3.0, 0.1));
  for (const std::vector<double>& angles : {std::vector{1.5, 4.5}, std::vector{2.0, 3.5}, std::vector{0.4, 5.0}}) {
    const auto one = motion_from(level, at_rest(level, angles, 2.5)),
               other = motion_from(tilted, at_rest(tilted, angles, 2.5));
    ASSERT_TRUE(one && other);
    if (one->kind != MotionKind::equilibrium) continue;
    EXPECT_EQ(name_of(level, *one), name_of(tilted, *other));
    EXPECT_NEAR(one->speed, other->speed, 1e-5);
    EXPECT_NEAR(one->r_max, other->r_max, 1e-5);
  }
}

}  // namespace machine_motions_test
}  // namespace equipoise
