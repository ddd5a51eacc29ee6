// Machines with known results: a heavy rotor turns as prescribed, energy without a motor never grows, balls never
// overlap, friction leaves a residual unbalance, a weak motor stalls. (machine_labels_test.cpp tests the names of
// outcomes.)
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace machine_limits_test {

using equipoise::parse_study;
using equipoise::Study;
using equipoise::Trajectory;

std::string study_text(const std::string& rotor, const std::string& balancer, const std::string& speed) {
  return "[rotor]\neccentricity = 0.01\ndamping = 0.5\n" + rotor +
         "\n[balancer]\nballs = 2\nmass = 0.05\ndrag = 0.05\n" + balancer + "\n[speed]\n" + speed +
         "\n[initial]\nphi = [1.0, 4.0]\n";
}

std::vector<double> times_until(double end, int count) {
  std::vector<double> times;
  for (int k = 0; k <= count; ++k) times.push_back(end * k / count);
  return times;
}

double largest_difference(const Trajectory& a, const Trajectory& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.t.size(); ++k)
    largest = std::max({largest, std::fabs(a.radial[k] - b.radial[k]), std::fabs(a.phi[0][k] - b.phi[0][k]),
                        std::fabs(a.phi[1][k] - b.phi[1][k])});
  return largest;
}

// EQUATIONS: tau = iota a0 with iota to infinity is the prescribed ramp; the effect of the rotor's vibration on its
// speed falls as 1/iota.
TEST(MachineLimits, AHeavyRotorTurnsAsPrescribed) {
  const auto times = times_until(60.0, 60);
  const std::string release = "\n[release]\nspeed = 1.2\n";
  const Study ramp =
      parse_study(study_text("", "", "profile = \"ramp\"\nfinal = 2.4\nduration = 40.0") + release, "ramp");
  const Trajectory prescribed = simulate(ramp, times);
  double before = 0.0;
  for (const double inertia : {1e4, 1e5, 1e6}) {
    const std::string speed = fmt::format(
        "profile = \"torque\"\ninitial = 0.0\ntorque = {{ constant = {}, until = 40.0 }}", inertia * 2.4 / 40.0);
    const Study driven = parse_study(study_text(fmt::format("inertia = {}", inertia), "", speed) + release, "driven");
    const double difference = largest_difference(simulate(driven, times), prescribed);
    EXPECT_GT(difference, 0.0);
    if (before > 0.0) {
      // Proportional to 1/iota: ten times less, up to the next order.
      EXPECT_NEAR(before / difference, 10.0, 1.0) << inertia;
    }
    before = difference;
  }
  EXPECT_LT(before, 1e-4);
}

// For a trajectory without a motor, from its output columns.
std::vector<double> energies(const Study& study, const Trajectory& run) {
  using namespace equipoise::model;
  const int n = study.parameters.balls;
  std::vector<double> result;
  for (std::size_t k = 0; k < run.t.size(); ++k) {
    std::vector<double> z(machine_layout(n).size);
    const double w = run.psi_dot[k];
    z[index::x] = run.x[k];
    z[index::y] = run.y[k];
    z[index::u] = run.x_dot[k] - w * run.y[k];
    z[index::v] = run.y_dot[k] + w * run.x[k];
    for (int i = 0; i < n; ++i) {
      z[index::phi(i)] = run.phi[i][k];
      z[index::q(i, n)] = run.phi_dot[i][k];
    }
    z[machine_layout(n).psi] = run.psi[k];
    z[machine_layout(n).speed] = w;
    result.push_back(full_energy(study.parameters, z.data()));
  }
  return result;
}

TEST(MachineLimits, EnergyWithoutAMotorNeverGrows) {
  struct Option {
    const char* name;
    std::string balancer;
    bool conserves;
  };
  const std::vector<Option> options{{"none", "", true},
                                    {"race offset", "race_offset = [0.02, 0.01]", true},
                                    {"balls that roll", "rolls = true\nball_radius = 0.2", true},
                                    {"elastic contact", "contact_angle = 0.5\nrestitution = 1.0", true},
                                    {"elastic contact of balls that roll",
                                     "rolls = true\nball_radius = 0.25\ncontact_angle = 0.5\nrestitution = 1.0", true},
                                    {"contact", "contact_angle = 0.5\nrestitution = 0.5", false},
                                    {"plastic contact", "contact_angle = 0.5\nrestitution = 0.0", false},
                                    {"rolling", "rolling = 0.01\nstiction = 0.02", false}};
  for (const Option& option : options) {
    SCOPED_TRACE(option.name);
    // No damping of the supports and no drag: only the option dissipates energy.
    std::string text = study_text("inertia = 3.0\ngravity = 0.01", option.balancer,
                                  "profile = \"torque\"\ninitial = 2.0\ntorque = { constant = 0.0 }");
    text.replace(text.find("damping = 0.5"), 13, "damping = 0.0");
    text.replace(text.find("drag = 0.05"), 11, "drag = 0.0");
    text += "phi_dot = [1.5, -1.0]\n";
    const Study study = parse_study(text, option.name);
    const Trajectory run = simulate(study, times_until(60.0, 240));
    ASSERT_EQ(run.status, equipoise::IntegrationStatus::done);
    const auto e = energies(study, run);
    // Steps err by 1e-12 each of energies about 8; a few hundred of them.
    constexpr double rounding = 1e-8;
    for (std::size_t k = 1; k < e.size(); ++k) EXPECT_LE(e[k], e[k - 1] + rounding) << run.t[k];
    if (option.conserves)
      EXPECT_NEAR(e.back(), e.front(), rounding);
    else
      EXPECT_LT(e.back(), e.front() - 1e-5);
  }
}

TEST(MachineLimits, BallsThatCollideNeverOverlap) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    std::string text = study_text("", fmt::format("contact_angle = 0.4\nrestitution = {}", restitution),
                                  "profile = \"constant\"\nspeed = 2.0");
    text.replace(text.find("balls = 2"), 9, "balls = 3");
    text.replace(text.find("[1.0, 4.0]"), 10, "[1.0, 2.0, 4.0]");
    const Study study = parse_study(text, "contact");
    const Trajectory run = simulate(study, times_until(150.0, 3000));
    ASSERT_EQ(run.status, equipoise::IntegrationStatus::done);
    double least = 10.0;
    for (std::size_t k = 0; k < run.t.size(); ++k)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < i; ++j)
          least = std::min(least, std::fabs(equipoise::wrapped(run.phi[i][k] - run.phi[j][k])));
    EXPECT_GT(least, 0.4 - 1e-9) << restitution;  // balls that stay together keep their distance but for step errors
    EXPECT_LT(least, 0.45) << restitution;        // they did meet
  }
}

// Stiction holds the balls where the force that still moves them is too small: the rotor keeps a residual unbalance.
TEST(MachineLimits, StictionLeavesAResidualUnbalance) {
  const std::string constant = "profile = \"constant\"\nspeed = 2.4";
  const auto residual = [&](const std::string& balancer) {
    const Study study = parse_study(study_text("", balancer, constant), "stiction");
    return simulate(study, times_until(1500.0, 2)).radial.back();
  };
  EXPECT_LT(residual("race_offset = [1e-12, 0.0]"), 1e-8);
  const double small = residual("rolling = 1e-4"), large = residual("rolling = 1e-3");
  EXPECT_GT(small, 1e-6);
  EXPECT_GT(large, small);
}

TEST(MachineEnsemble, AWeakMotorStallsAndAStrongOneDoesNot) {
  const auto outcomes = [](double stall) {
    std::string text = study_text(
        "inertia = 1.0", "",
        fmt::format("profile = \"torque\"\ntorque = {{ stall = {}, no_load_speed = 3.0 }}\n[sampling]\nstarts = 12",
                    stall));
    text.replace(text.find("eccentricity = 0.01"), 19, "eccentricity = 0.05");
    text.replace(text.find("damping = 0.5"), 13, "damping = 0.1");
    const Study study = parse_study(text, "motor");
    std::map<equipoise::OutcomeKind, int> count;
    equipoise::BasinOptions options;
    options.outcome = [&](const equipoise::Outcome& outcome) { ++count[outcome.kind]; };
    equipoise::basin(study, options);
    return count;
  };
  EXPECT_EQ(outcomes(0.005)[equipoise::OutcomeKind::stalled], 12);
  EXPECT_EQ(outcomes(0.05)[equipoise::OutcomeKind::stalled], 0);
}

}  // namespace machine_limits_test
