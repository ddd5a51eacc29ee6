// simulate() of machines (motor, off-centre race, contact, rolling resistance, stiction) against mass points in fixed
// axes (machine_reference.hpp), the energy balance and the limit of a heavy rotor.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "equipoise/simulation/trajectory/simulate.hpp"
#include "machine_reference.hpp"

namespace machine_test {

using equipoise::parse_study;
using equipoise::Study;
using equipoise::Trajectory;

struct Case {
  std::string name, toml;
  double until;
  double accuracy;  // given by the reference's steps
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

std::string rotor(const std::string& more = "inertia = 4.0") {
  return "[rotor]\neccentricity = 0.02\ndamping = [0.4, 0.3]\nstiffness = [1.0, 1.3]\ngravity = 0.02\n" + more + "\n";
}
std::string balls(int n, const std::string& more = "") {
  static const char* const mass[] = {
      "", "[0.05]", "[0.05, 0.03]", "[0.03, 0.05, 0.02]", "", "[0.02, 0.03, 0.01, 0.02, 0.025]"};
  static const char* const drag[] = {"", "[0.2]", "[0.2, 0.15]", "[0.2, 0.3, 0.25]", "", "[0.2, 0.3, 0.25, 0.2, 0.15]"};
  static const char* const phi[] = {"", "[1.0]", "[1.0, 4.0]", "[1.0, 3.0, 5.0]", "", "[0.5, 1.5, 3.0, 4.0, 5.5]"};
  std::string masses = n < 6 ? mass[n] : "", drags = n < 6 ? drag[n] : "", angles = n < 6 ? phi[n] : "";
  if (n > 5) {  // three kinds of balls around the race
    std::vector<double> m, d, a;
    for (int i = 0; i < n; ++i) {
      m.push_back(0.006 + 0.001 * (i % 3));
      d.push_back(0.2 + 0.05 * (i % 3));
      a.push_back(6.2 * i / n + 0.1 * std::sin(3.0 * i));
    }
    masses = fmt::format("{}", m);
    drags = fmt::format("{}", d);
    angles = fmt::format("{}", a);
  }
  return fmt::format("[balancer]\nballs = {}\nmass = {}\ndrag = {}\n{}\n[initial]\nphi = {}\npsi = 0.3\n", n, masses,
                     drags, more, angles);
}
std::string torque(const std::string& law, const std::string& initial = "0.5") {
  return "[speed]\nprofile = \"torque\"\ninitial = " + initial + "\ntorque = " + law + "\n";
}
const std::string constant = "[speed]\nprofile = \"constant\"\nspeed = 2.0\n";

// The reference's step of 4e-3 errs by 6e-11 until t = 35 with five balls, by comparison with half the step; impacts
// and starts are located to rounding. The growth of these errors differs from case to case.
std::vector<Case> cases() {
  std::vector<Case> all;
  const std::string at_speed = "[release]\nspeed = 0.9\n", at_time = "[release]\ntime = 7.3\n";
  for (int n : {1, 2, 3, 5, 12, 16})
    all.push_back({fmt::format("linear_{}", n),
                   rotor() + balls(n) + torque("{ constant = 0.3, slope = -0.1, until = 30.0 }") + at_speed, 35.0,
                   1e-9});
  all.push_back({"stall", rotor() + balls(2) + torque("{ stall = 0.4, no_load_speed = 3.0 }"), 25.0, 5e-9});
  // Corners of the curve and of the load lie in mid-step, where the reference errs by its step's square, 2e-5 of a
  // kink.
  all.push_back({"curve_and_fan",
                 rotor() + balls(2) +
                     torque("{ speeds = [0.0, 1.2, 2.0, 2.2], values = [0.3, 0.5, 0.4, 0.0] }\n"
                            "load = { constant = 0.02, linear = 0.03, quadratic = 0.1, at = 2.0 }"),
                 25.0, 2e-5});
  all.push_back({"table_against_a_fan",
                 rotor() + balls(3) +
                     torque("{ times = [2.0, 20.0, 30.0], values = [0.4, 0.2, 0.1] }\nload = { quadratic = 0.1, at = "
                            "2.0 }") +
                     at_time,
                 35.0, 5e-9});
  all.push_back({"table",
                 rotor() + balls(3) + torque("{ times = [2.0, 20.0, 30.0], values = [0.4, 0.2, -0.1] }") + at_time,
                 35.0, 5e-9});
  all.push_back({"control",
                 rotor() + balls(2) +
                     torque("{ gain = 0.8, target = { profile = \"ramp\", final = 2.5, duration = 20.0 } }", "0.0") +
                     at_speed,
                 25.0, 5e-9});
  // The limit is left in mid-step, where the reference errs in proportion to its step: 5e-5.
  all.push_back({"control_with_integral_and_limit",
                 rotor() + balls(2) +
                     torque("{ gain = 2.0, integral = 0.5, limit = 0.5, target = { profile = \"ramp\", initial = 1.0, "
                            "final = 2.5, duration = 10.0 } }"),
                 25.0, 2e-4});
  all.push_back(
      {"off_centre_race",
       rotor() + balls(3, "race_offset = [0.03, -0.02]") + torque("{ constant = 0.3, slope = -0.1 }") + at_speed, 25.0,
       1e-9});
  all.push_back(
      {"off_centre_race_at_constant_speed", rotor("") + balls(2, "race_offset = [0.01, 0.02]") + constant, 25.0, 5e-9});
  all.push_back(
      {"rolling",
       rotor() + balls(2, "rolling = 0.02\nstiction = 0.05") + torque("{ constant = 0.3, slope = -0.1 }") + at_speed,
       25.0, 5e-9});
  all.push_back(
      {"rolling_at_constant_speed", rotor("") + balls(3, "rolling = [0.01, 0.02, 0.03]") + constant, 25.0, 5e-9});
  all.push_back({"contact",
                 rotor() + balls(3, "contact_angle = 1.0\nrestitution = 0.9") +
                     torque("{ constant = 0.3, slope = -0.1 }") + at_speed,
                 20.0, 5e-9});
  const std::string rolls = "rolls = true\nball_radius = ", motor = torque("{ constant = 0.3, slope = -0.1 }");
  for (int n : {1, 2, 3, 5})
    all.push_back(
        {fmt::format("balls_roll_{}", n),
         rotor() + balls(n, rolls + "0.15") + torque("{ constant = 0.3, slope = -0.1, until = 30.0 }") + at_speed, 35.0,
         1e-9});
  all.push_back({"balls_of_two_sizes_roll_off_centre",
                 rotor() + balls(2, rolls + "[0.1, 0.4]\nrace_offset = [0.03, -0.02]") + motor + at_time, 25.0, 1e-9});
  all.push_back({"balls_roll_off_centre_at_constant_speed",
                 rotor("") + balls(2, rolls + "0.3\nrace_offset = [0.01, 0.02]") + constant, 25.0, 5e-9});
  all.push_back({"balls_roll_with_resistance",
                 rotor() + balls(2, rolls + "[0.1, 0.4]\nrolling = 0.02\nstiction = 0.05") + motor + at_speed, 25.0,
                 5e-9});
  all.push_back({"balls_roll_with_resistance_at_constant_speed",
                 rotor("") + balls(3, rolls + "0.2\nrolling = [0.01, 0.02, 0.03]") + constant, 25.0, 5e-9});
  all.push_back({"balls_roll_in_contact",
                 rotor() + balls(3, rolls + "0.48\ncontact_angle = 1.0\nrestitution = 0.9") + motor + at_speed, 20.0,
                 5e-9});
  all.push_back(
      {"balls_of_three_sizes_roll_in_contact",
       rotor() + balls(3, rolls + "[0.5, 0.1, 0.3]\ncontact_angle = 1.0\nrestitution = 0.9") + motor + at_speed, 20.0,
       5e-9});
  all.push_back({"contact_at_constant_speed", rotor("") + balls(2, "contact_angle = 1.2\nrestitution = 1.0") + constant,
                 20.0, 5e-9});
  return all;
}

class Machine : public testing::TestWithParam<Case> {};

TEST_P(Machine, MovesAsMassPointsDo) {
  const Case& c = GetParam();
  const Study study = parse_study(c.toml, c.name);
  std::vector<double> times;
  for (int k = 1; k <= 50; ++k) times.push_back(c.until * k / 50);
  const auto reference = machine_reference::integrate(study, times, 4e-3);
  const Trajectory run = equipoise::simulate(study, times);
  ASSERT_EQ(run.status, equipoise::IntegrationStatus::done);
  ASSERT_EQ(run.t.size(), times.size());
  double largest = 0.0;
  std::string worst;
  const auto compare = [&](const char* what, double a, double b, double size) {
    ASSERT_TRUE(std::isfinite(a));
    if (std::fabs(a - b) / size <= largest) return;
    largest = std::fabs(a - b) / size;
    worst = what;
  };
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto& r = reference[k];
    const double cosine = std::cos(run.psi[k]), sine = std::sin(run.psi[k]);
    compare("X", run.x[k] * cosine - run.y[k] * sine, r.X, 0.1);
    compare("Y", run.x[k] * sine + run.y[k] * cosine, r.Y, 0.1);
    compare("psi", run.psi[k], r.psi, 1.0);
    compare("psi'", run.psi_dot[k], r.psi_dot, 1.0);
    for (int i = 0; i < study.parameters.balls; ++i) {
      compare("phi", run.phi[i][k], r.theta[i] - r.psi, 1.0);
      compare("phi'", run.phi_dot[i][k], r.theta_dot[i] - r.psi_dot, 1.0);
    }
  }
  RecordProperty("largest_difference", fmt::format("{:.2g} in {}", largest, worst));
  EXPECT_LT(largest, c.accuracy) << worst;

  // The reference's own balance, so that both also agree with energy conservation: neither drag, nor rolling
  // resistance, nor impacts return any. The powers are integrated with the error of its steps.
  const auto &from = reference.front(), &to = reference.back();
  const double taken = to.supports - from.supports + to.balls - from.balls + to.impacts - from.impacts;
  EXPECT_NEAR(to.energy - from.energy, to.work - from.work - taken, 1e-8 * (1.0 + std::fabs(to.energy)));
  EXPECT_GE(to.balls, from.balls);
  EXPECT_GE(to.impacts, from.impacts - 1e-12);
  if (study.parameters.balls_collide()) {
    EXPECT_EQ(to.impacts > 1e-9, study.parameters.restitution < 1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Case, Machine, testing::ValuesIn(cases()), [](const auto& info) { return info.param.name; });

}  // namespace machine_test
