// Systems: sections, states and symmetries; the general equations' rates against those of the plain ones; flows and
// their derivatives against simulate() and against differences of whole trajectories.
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/mechanics/capability.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "../support/snapshots.hpp"

namespace equipoise {
namespace system_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::Section;
using model::System;

model::Parameters rotor(int balls, bool level = true, bool centred = true) {
  model::Parameters p;
  p.balls = balls;
  p.inertia = 0.3;
  for (int i = 0; i < balls; ++i) {
    p.mass[i] = 0.03 + 0.005 * i;
    p.drag[i] = 0.1 + 0.02 * i;
  }
  if (!level) {
    p.gravity = 0.02;
    p.stiffness = {1.0, 1.2};
    p.damping = {0.4, 0.5};
  }
  if (!centred) p.race_offset = {0.01, -0.02};
  return p;
}

// A speed control that aims at 2.2.
model::DrivePiece motor(double integral) {
  model::DrivePiece piece;
  piece.prescribed = false;
  piece.motor.slope = -0.8;
  piece.motor.constant = 0.8 * 2.2;
  piece.motor.integral = integral;
  piece.motor.aim = 2.2;
  return piece;
}

struct Case {
  std::string name;
  System system;
};

std::vector<Case> systems() {
  std::vector<Case> all;
  for (const int n : {1, 2, 3}) {
    const std::string balls = std::to_string(n) + " balls: ";
    all.push_back({balls + "plain", System(rotor(n), 1.9)});
    all.push_back({balls + "strobed", System(rotor(n, false), 1.9)});
    all.push_back({balls + "off-centre race", System(rotor(n, true, false), 1.9)});
    all.push_back({balls + "strobed, off-centre race", System(rotor(n, false, false), 1.9)});
    all.push_back({balls + "motor", System(rotor(n), motor(0.0))});
    all.push_back({balls + "motor with integral", System(rotor(n), motor(0.3))});
    all.push_back({balls + "motor under gravity", System(rotor(n, false, false), motor(0.3))});
  }
  return all;
}

VectorXd some_state(const System& s) {
  VectorXd y(s.dimension());
  for (int i = 0; i < y.size(); ++i) y[i] = std::sin(1.0 + 1.7 * i);
  y.head(4) *= 0.1;
  for (int i = 0; i < s.balls(); ++i) y[model::index::q(i, s.balls())] *= 0.3;
  if (s.layout().speed >= 0) y[s.layout().speed] = 1.9;
  return y;
}

TEST(System, SectionAndStateFollowFromParametersAndDrive) {
  const System plain(rotor(2), 2.0), strobed(rotor(2, false), 2.0), turning(rotor(2, false), motor(0.3)),
      driven(rotor(2), motor(0.0));
  EXPECT_EQ(plain.section(), Section::none);
  EXPECT_EQ(plain.dimension(), 8);
  EXPECT_EQ(plain.layout().speed, -1);
  EXPECT_EQ(strobed.section(), Section::stroboscopic);
  EXPECT_EQ(strobed.dimension(), 8);
  EXPECT_DOUBLE_EQ(strobed.section_period(), two_pi / 2.0);
  EXPECT_EQ(driven.section(), Section::none);
  EXPECT_EQ(driven.dimension(), 9);
  EXPECT_EQ(driven.layout().speed, 8);
  EXPECT_EQ(driven.layout().error, -1);
  EXPECT_EQ(turning.section(), Section::turn);
  EXPECT_EQ(turning.dimension(), 11);
  EXPECT_EQ(turning.layout().psi, 8);
  EXPECT_EQ(turning.layout().speed, 9);
  EXPECT_EQ(turning.layout().error, 10);
  EXPECT_EQ(turning.angles().size(), 3u);
  EXPECT_EQ(turning.angles().back().place, 8);

  model::Parameters level = rotor(2);
  level.stiffness = {1.0, 1.2};  // unchanged after half a turn
  EXPECT_DOUBLE_EQ(System(level, 2.0).section_angle(), pi);
  EXPECT_DOUBLE_EQ(System(level, motor(0.0)).angles().back().turn, pi);

  model::Parameters eventful = rotor(2);
  eventful.stiction[1] = 0.01;
  EXPECT_FALSE(System(eventful, 2.0).smooth());
  EXPECT_TRUE(System(eventful, 2.0).events().stick);
  EXPECT_TRUE(plain.smooth());
  EXPECT_FALSE(plain.alike(0, 1));
  EXPECT_TRUE(plain.alike(1, 1));
}

// Two solutions of one linear system, by different elimination: equal to rounding of terms of size one.
TEST(System, GeneralEquationsAreThePlainOnes) {
  namespace kernels = HWY_NAMESPACE;
  for (const bool level : {true, false}) {
    const System s(rotor(3, level), 1.9);
    const VectorXd y = some_state(s);
    for (const double psi : {0.0, 0.7}) {
      double z[kernels::SmoothFlow<double, 3>::dimension] = {}, dz[kernels::SmoothFlow<double, 3>::dimension];
      std::copy(y.begin(), y.end(), z);
      kernels::SmoothFlow<double, 3>(s, psi)(0.0, z, dz);
      const VectorXd plain = model::rate(s, y, psi);
      EXPECT_LT((plain - Eigen::Map<VectorXd>(dz, y.size())).lpNorm<Eigen::Infinity>(), 1e-14) << psi;
    }
  }
}

// Central differences: with steps of 1e-5 their own error is about 1e-10 of the third derivative, and integration
// errors of 1e-12 per step count a hundred thousand times.
TEST(System, DerivativesAreThoseOfRatesAndOfWholeTrajectories) {
  constexpr double step = 1e-5, duration = 3.0, psi = 0.4;
  for (const auto& [name, s] : systems()) {
    const VectorXd y = some_state(s);
    const auto flight = follow_derivative(s, y, duration, 1e-12, psi);
    ASSERT_TRUE(flight) << name;
    const auto end = advance_state(s, y, duration, psi);
    ASSERT_TRUE(end) << name;
    EXPECT_LT((*end - flight->end).lpNorm<Eigen::Infinity>(), 1e-10) << name;
    const MatrixXd jacobian = model::jacobian(s, y, psi);
    for (int k = 0; k < s.dimension(); ++k) {
      VectorXd up = y, down = y;
      up[k] += step;
      down[k] -= step;
      const VectorXd slope = (model::rate(s, up, psi) - model::rate(s, down, psi)) / (2.0 * step);
      EXPECT_LT((slope - jacobian.col(k)).lpNorm<Eigen::Infinity>(), 1e-8) << name << ", component " << k;
      const VectorXd change =
          (*advance_state(s, up, duration, psi) - *advance_state(s, down, duration, psi)) / (2.0 * step);
      EXPECT_LT((change - flight->tangents.col(k)).lpNorm<Eigen::Infinity>(), 1e-6) << name << ", component " << k;
    }
  }
}

// The same trajectories as from another integrator of the same machine, in which the rotor's angle is always a state.
TEST(System, FlowsAreWhatSimulateFollows) {
  const std::string common =
      "[rotor]\neccentricity = 0.01\ndamping = [0.5, 0.6]\nstiffness = [1.0, 1.2]\n"
      "gravity = 0.01\n[balancer]\nballs = 2\nmass = [0.05, 0.04]\ndrag = 0.1\n"
      "race_offset = [0.01, 0.0]\n[initial]\nphi = [1.0, 4.0]\nx = 0.01\ny = -0.02\n";
  for (const std::string& speed :
       {std::string("[speed]\nprofile = \"torque\"\ninitial = 1.8\ntorque = { constant = 0.9, slope = -0.4 }\n"
                    "[release]\ntime = 0.0\n"),
        std::string("[speed]\nprofile = \"constant\"\nspeed = 1.8\n")}) {
    const bool driven = speed.find("torque") != std::string::npos;
    const Study study = parse_study(
        common + speed, "study", driven ? std::vector<std::string>{"rotor.inertia=0.4"} : std::vector<std::string>{});
    constexpr double duration = 20.0;
    const Trajectory path = simulate(study, {0.0, duration});
    const System s(study.parameters, study.drive().pieces.back());
    const auto state = [&](std::size_t k) {
      VectorXd y(s.dimension());
      const double w = path.psi_dot[k];
      y.head(4) << path.x[k], path.y[k], path.x_dot[k] - w * path.y[k], path.y_dot[k] + w * path.x[k];
      for (int i = 0; i < 2; ++i) {
        y[model::index::phi(i)] = path.phi[i][k];
        y[model::index::q(i, 2)] = path.phi_dot[i][k];
      }
      if (driven) {
        y[s.layout().psi] = path.psi[k];
        y[s.layout().speed] = w;
      }
      return y;
    };
    const auto end = advance_state(s, state(0), duration);
    ASSERT_TRUE(end);
    EXPECT_LT((*end - state(1)).lpNorm<Eigen::Infinity>(), 1e-9);  // a hundred steps of 1e-12, grown tenfold or less
  }
}

// Every kind of result with needs refuses what it lacks, in one line that names the commands without this need.
TEST(System, WhatAnAnswerLacksIsSaid) {
  using model::Need;
  using model::ResultKind;
  const System plain(rotor(2), 2.0), strobed(rotor(2, false), 2.0), driven(rotor(2), motor(0.0)),
      off_centre(rotor(2, true, false), 2.0), still(rotor(2, false), 0.0), hanging(rotor(2, false), motor(0.0));
  model::Parameters sticky = rotor(2), crowd = rotor(3, false);
  sticky.rolling[0] = 0.01;
  crowd.contact_angle = 0.1;
  model::DrivePiece idle = motor(0.0);
  idle.motor.slope = idle.motor.constant = 0.0;
  const System coasting(rotor(2), idle), touching(crowd, 2.0);
  for (const model::Capability& c : model::capabilities) {
    const auto lacks = [&](const System& system) { return model::lacking(system, c.result).has_value(); };
    EXPECT_FALSE(lacks(plain)) << c.name;
    EXPECT_EQ(&model::capability(c.result), &c) << c.name;
    EXPECT_EQ(lacks(strobed), c.needs.has(Need::equal_supports)) << c.name;
    EXPECT_EQ(lacks(driven), c.needs.has(Need::prescribed_speed)) << c.name;
    EXPECT_EQ(lacks(off_centre), c.needs.has(Need::centred_race)) << c.name;
    EXPECT_EQ(lacks(System(sticky, 2.0)), c.needs.has(Need::sliding_balls)) << c.name;
    EXPECT_EQ(lacks(still), c.needs.has(Need::equal_supports) || c.needs.has(Need::turning)) << c.name;
    EXPECT_EQ(lacks(coasting), c.needs.has(Need::prescribed_speed) || c.needs.has(Need::lasting_drive)) << c.name;
    EXPECT_EQ(lacks(hanging), c.needs.has(Need::prescribed_speed) || c.needs.has(Need::equal_supports)) << c.name;
    EXPECT_EQ(lacks(touching), c.needs.has(Need::passing_balls) || c.needs.has(Need::equal_supports)) << c.name;
  }
  EXPECT_EQ(model::lacking(strobed, ResultKind::proofs)->reason,
            "proofs need equal values in x and y (simulate, basin, attractors and map take any)");
  EXPECT_FALSE(model::lacking(driven, ResultKind::proofs));
  EXPECT_EQ(model::lacking(driven, ResultKind::displacements)->reason,
            "observed displacements need a prescribed speed (simulate, basin, attractors, map and chart take any)");
  EXPECT_EQ(model::lacking(coasting, ResultKind::maps)->reason,
            "maps need a drive that lasts (simulate and basin take any)");
  EXPECT_EQ(model::lacking(still, ResultKind::shares)->reason,
            "shares need a rotor that turns in the end (other than 0) where supports are unequal or gravity acts "
            "(simulate takes any)");
}

TEST(System, NeedsOfAnswersStandInTheGuide) {
  std::string table;
  for (const model::Capability& c : model::capabilities) {
    std::string needs;
    for (const model::Need need : model::all_needs)
      if (c.needs.has(need)) needs += (needs.empty() ? "" : "; ") + std::string(model::words(need));
    table += fmt::format("| {} | {} | {} |\n", c.name, *c.command ? fmt::format("`{}`", c.command) : "",
                         needs.empty() ? "nothing" : needs);
  }
  expect_in_docs("reference/commands/index.md",
                 {{"needs of answers", "| answer | command | needs |\n|---|---|---|\n" + table}});
}

}  // namespace system_test
}  // namespace equipoise
