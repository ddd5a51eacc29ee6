// Level sets around balanced states and periodic motions of motors and off-centre races, against whole trajectories.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/balanced_regions/balanced_region.hpp"
#include "equipoise/classification/trapping_regions/continuum_region.hpp"
#include "equipoise/classification/trapping_regions/orbit_region.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"

namespace equipoise {
namespace machine_regions_test {

using Eigen::VectorXd;
using model::System;

model::Parameters rotor() {
  model::Parameters p;  // lambda = 0.01, zeta = 0.5, two balls
  p.inertia = 0.5;
  p.mass.fill(0.05);
  p.drag.fill(0.05);
  return p;
}
model::Parameters off_centre(model::Parameters p) {
  p.race_offset = {0.005, 0.002};
  return p;
}
model::Parameters under_gravity(model::Parameters p) {
  p.gravity = 0.01;
  return p;
}

// Supplies no torque at `speed`.
model::DrivePiece motor_for(double speed, double gain, double integral = 0.0) {
  model::DrivePiece piece;
  piece.prescribed = false;
  piece.motor.constant = gain * speed;
  piece.motor.slope = -gain;
  piece.motor.integral = integral;
  piece.motor.aim = speed;
  return piece;
}

struct Case {
  std::string name;
  System system;
};
std::vector<Case> balancing() {
  model::Parameters unequal = off_centre(rotor());
  unequal.mass[1] = 0.045;
  return {{"motor", {rotor(), motor_for(3.0, 0.1)}},
          {"weak motor", {rotor(), motor_for(3.0, 0.01)}},
          {"control", {rotor(), motor_for(2.4, 0.5, 0.1)}},
          {"off-centre race", {off_centre(rotor()), 2.4}},
          {"unequal balls off centre", {unequal, 2.6}},
          {"motor off centre, backwards", {off_centre(rotor()), motor_for(-3.0, 0.1)}}};
}

TEST(MachineRegions, StatesOnABalancedLevelComeToBalance) {
  for (const Case& c : balancing()) {
    const BalancedAnalysis analysis = analyse_balanced(c.system);
    EXPECT_TRUE(analysis.stable) << c.name;
    EXPECT_EQ(analysis.note, "") << c.name;
    ASSERT_EQ(analysis.regions.size(), 2u) << c.name;
    const double speed = *model::balanced_speed(c.system);
    Directions random(c.system.dimension());
    for (const BalancedRegion& region : analysis.regions) {
      EXPECT_GT(region.level, 0.0) << c.name;
      const VectorXd centre = model::balanced_state(c.system, speed, region.angles());
      for (Eigen::Index i = 0; i < centre.size(); ++i) EXPECT_NEAR(region.place[i], centre[i], 1e-12) << c.name;
      const auto depth = [&](const VectorXd& z) { return (z - centre).dot(form_of(region) * (z - centre)); };
      for (int k = 0; k < 30; ++k) {
        const VectorXd z = state_on_level(region, region.level, random.next());
        EXPECT_NEAR(depth(z), region.level, 1e-9 * region.level) << c.name;
        for (Eigen::Index i = 0; i < z.size(); ++i) EXPECT_LE(std::fabs(z[i] - centre[i]), region.reach[i]) << c.name;
        // V falls all the way: checked at the beginning, where it would fail first, and at the end.
        const auto soon = advance_state(c.system, z, 0.01);
        ASSERT_TRUE(soon);
        EXPECT_LT(depth(*soon), region.level) << c.name;
        if (k % 10 != 0) continue;
        const auto late = advance_state(c.system, z, 6.0 / -analysis.slowest_rate);
        ASSERT_TRUE(late);
        EXPECT_LT(depth(*late), 1e-3 * region.level) << c.name;  // e^-12 and nonlinear terms
      }
    }
  }
}

TEST(MachineRegions, MirrorImagesHaveTheSameLevel) {
  model::Parameters p = off_centre(rotor()), mirrored = p;
  mirrored.race_offset[1] = -p.race_offset[1];
  const BalancedAnalysis one = analyse_balanced({p, motor_for(3.0, 0.1)}),
                         other = analyse_balanced({mirrored, motor_for(-3.0, 0.1)});
  ASSERT_EQ(one.regions.size(), 2u);
  ASSERT_EQ(other.regions.size(), 2u);
  for (int k : {0, 1}) EXPECT_NEAR(one.regions[k].level / other.regions[k].level, 1.0, 1e-12);
  EXPECT_NEAR(one.slowest_rate, other.slowest_rate, 1e-12);
}

// Three balls and more in an off-centre race, and under a motor: drawn members of the continuum are at rest, and their
// form holds on the way to them.
TEST(MachineRegions, AContinuumIsSampledForEverySmoothSystem) {
  model::Parameters p = rotor();
  p.balls = 3;
  p.mass.fill(0.03);
  p.drag.fill(0.25);
  for (const System& system :
       {System(off_centre(p), 3.0), System(p, motor_for(3.0, 0.1)), System(off_centre(p), motor_for(3.0, 0.1, 0.02))}) {
    const BalancedAnalysis analysis = analyse_balanced(system);
    ASSERT_TRUE(analysis.continuum);
    EXPECT_TRUE(analysis.stable);
    EXPECT_GT(analysis.sample.share(), 0.5);
    ASSERT_EQ(analysis.motions.size(), 1u);
    EXPECT_EQ(motion_name(system.parameters(), analysis.motions[0]).name, "balanced");
    Directions random(analysis.continuum->directions());
    const auto& members = analysis.sample.members;
    for (std::size_t k = 0; k < members.size(); k += members.size() / 5) {
      const auto member = analysis.continuum->member(members[k].data());
      ASSERT_TRUE(member);
      EXPECT_NEAR(member->rate, analysis.sample.rates[k], 1e-6 - 1e-3 * member->rate);
      const VectorXd z = analysis.continuum->state_at(*member, 0.1 * member->unit, random.next());
      const auto late = advance_state(system, z, 8.0 / -member->rate);
      ASSERT_TRUE(late);
      const auto destination = analysis.continuum->destination(*late);
      ASSERT_TRUE(destination);
      EXPECT_LT(analysis.continuum->value(*destination, *late), 1e-3 * 0.1 * member->unit);
    }
  }
}

// Where the rotor's angle is part of the state and tells the phase: V vanishes on the motion and falls next to it as
// designed, like e^{-1.6 rate t} or faster.
TEST(MachineRegions, CyclesUnderAMotorAreToldByTheRotorsAngle) {
  model::Parameters heavy = under_gravity(rotor());
  heavy.eccentricity = 0.05;
  heavy.mass.fill(0.01);
  for (const System& system :
       {System(under_gravity(rotor()), motor_for(3.0, 0.1)),
        System(off_centre(under_gravity(rotor())), motor_for(-3.0, 0.05)), System(heavy, motor_for(3.0, 0.1))}) {
    VectorXd start = VectorXd::Zero(system.dimension());
    start[4] = 1.5;
    start[5] = 4.6;
    start[system.layout().speed] = 0.95 * system.pace();
    const auto motion = motion_from(system, start);
    ASSERT_TRUE(motion);
    ASSERT_EQ(motion->kind, MotionKind::periodic);
    const auto regions = orbit_regions(system, *motion, 1);
    ASSERT_EQ(regions.size(), 1u);
    OrbitRegion region = regions.front();
    EXPECT_EQ(region.clock, OrbitRegion::rotor);
    region.level = 1e300;
    const double shrinks = motion->orbit.slowest_rate();
    for (const VectorXd& y : sample_orbit(system, motion->orbit, 37))
      EXPECT_LT(value(system, region, y.data(), 0.0), 1e-8);  // cubic between angles 0.2 apart: 1e-6 of an amplitude
    Directions random(directions(region));
    constexpr double level = 1e-6;  // of linear theory, but far above the errors of interpolation
    for (int row = 0; row < region.rows(); row += 5) {
      const VectorXd z = state_on_level(region, row, level, random.next());
      EXPECT_NEAR(value(system, region, z.data(), 0.0), level, 1e-3 * level);
      const auto later = advance_state(system, z, 5.0 * motion->period);
      ASSERT_TRUE(later);
      EXPECT_LT(value(system, region, later->data(), 0.0),
                1.05 * level * std::exp(1.6 * shrinks * 5.0 * motion->period));
    }
  }
}

// Levels found by tries on lanes hold for trajectories followed one by one, also at their edge.
TEST(MachineRegions, ValidatedLevelsLeadToTheirMotion) {
  for (const System& system : {System(rotor(), motor_for(3.0, 0.1)), System(off_centre(rotor()), 2.4),
                               System(under_gravity(rotor()), motor_for(3.0, 0.1))}) {
    const bool turns = system.section() == model::Section::turn;
    VectorXd start = VectorXd::Zero(system.dimension());
    start[4] = turns ? 1.5 : 1.0;
    start[5] = turns ? 4.6 : 1.0;
    if (system.layout().speed >= 0) start[system.layout().speed] = 2.9;
    const auto motion = motion_from(system, start);
    ASSERT_TRUE(motion);
    ASSERT_EQ(motion->kind, MotionKind::periodic);
    auto regions = orbit_regions(system, *motion, 2);
    ASSERT_FALSE(regions.empty());
    const double rate = motion->orbit.slowest_rate();
    ASSERT_TRUE(validate(regions, {&system, 1e-6, 1, nullptr, nullptr}, rate));
    const OrbitRegion& region = regions.front();
    EXPECT_GT(region.level, 0.0);
    Directions random(directions(region));
    for (int k = 0; k < 12; ++k) {
      const VectorXd z = state_on_level(region, 11 * k % region.rows(), region.level, random.next());
      const auto late = advance_state(system, z, 10.0 / -rate);
      ASSERT_TRUE(late);
      // e^-20, nonlinear terms, and chords between rows of a ball's table (3e-4 of the curvature).
      EXPECT_LT(value(system, region, late->data(), 0.0), 1e-3 * region.level);
    }
  }
}

TEST(MachineRegions, ContinuaHaveTheirLevelToo) {
  model::Parameters p = rotor();
  p.balls = 3;
  p.mass.fill(0.03);
  p.drag.fill(0.25);
  for (const System& system : {System(off_centre(p), 3.0), System(p, motor_for(3.0, 0.1))}) {
    const BalancedAnalysis analysis = analyse_balanced(system);
    const auto region = continuum_region(analysis.continuum, analysis.sample, {&system, 1e-6, 1, nullptr, nullptr});
    ASSERT_TRUE(region);
    EXPECT_GT(region->factor, 0.0);
    const auto member = analysis.continuum->member(analysis.sample.typical.data());
    ASSERT_TRUE(member);
    EXPECT_TRUE(region->holds(member->centre));
    VectorXd away = member->centre;
    away[model::index::q(0, 3)] += 1.0;
    EXPECT_FALSE(region->holds(away));
  }
}

}  // namespace machine_regions_test
}  // namespace equipoise
