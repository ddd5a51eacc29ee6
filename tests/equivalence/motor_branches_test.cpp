// Motions continued along a motor's torque: where the rotor's hang-up at resonance ends, against a closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "equipoise/analyses/continuation/continuation.hpp"

namespace equipoise {
namespace motor_branches_test {

// Balls too light to balance it.
Study heavy_rotor() {
  return parse_study(R"([rotor]
eccentricity = 0.05
damping = 0.1
inertia = 0.5
[balancer]
balls = 2
mass = 0.01
drag = 0.05
[speed]
profile = "torque"
initial = 0.0
torque = { stall = 0.02, no_load_speed = 3.0 }
)",
                     "heavy rotor", {});
}

// The stall torque at which the motor's line touches the resonance. Both balls rest where the rotor bulges out, so its
// displacement r e^{i phi} is that of a rotor with the unbalance lambda + 2 mu e^{i phi}. It absorbs the torque zeta
// Omega r^2 of a motor that supplies T (1 - Omega / 3).
double torque_at_speed(double w) {
  constexpr double lambda = 0.05, balls = 0.02, zeta = 0.1;
  const double a = 1.0 - (1.0 + balls) * w * w, b = balls * w * w, c = zeta * w;
  // (r a - b)^2 + (r c)^2 = (lambda w^2)^2
  const double half = a * b / (a * a + c * c);
  const double r = half + std::sqrt(half * half + (std::pow(lambda * w * w, 2) - b * b) / (a * a + c * c));
  return zeta * w * r * r / (1.0 - w / 3.0);
}
double torque_that_passes() {
  double highest = 0.0;
  for (double w = 0.9; w < 1.05; w += 1e-6) highest = std::max(highest, torque_at_speed(w));
  return highest;
}

TEST(MotorBranches, TheHangUpAtResonanceEndsWhereTheMotorsLineLeavesTheResonance) {
  const Study study = heavy_rotor();
  ContinuationOptions options;
  options.threads = 2;
  const BranchesResult result =
      follow_attractors(study, ParameterLine(study, "speed.torque.stall=0.02:0.036:0.004"), options);
  const auto named = [&](const std::string& name) {
    const auto at =
        std::find_if(result.branches.begin(), result.branches.end(), [&](const Branch& b) { return b.name == name; });
    return at == result.branches.end() ? nullptr : &*at;
  };
  const Branch* running = named("locked");
  ASSERT_TRUE(running);
  EXPECT_EQ(running->points.size(), result.values.size());
  EXPECT_TRUE(running->events.empty());
  const Branch* captured = named("locked, captured at resonance");
  ASSERT_TRUE(captured);
  ASSERT_EQ(captured->events.size(), 1u);
  const BranchEvent& end = captured->events.front();
  EXPECT_EQ(end.change, BranchChange::death);
  EXPECT_EQ(end.cause, BranchCause::fold);
  // Ends are located to 2^-16 of a step, the maximum of the closed form to 1e-6^2 of its curvature.
  const double passes = torque_that_passes();
  EXPECT_LT(end.high - end.low, 0.004 / 10000);
  EXPECT_NEAR(end.middle(), passes, 0.004 / 10000);
  EXPECT_LE(end.low, passes + 1e-9);
  for (const BranchPoint& point : captured->points) {
    ASSERT_TRUE(point.motion.motor);
    EXPECT_NEAR(torque_at_speed(point.motion.speed), point.value, 1e-9);
    EXPECT_TRUE(point.motion.stable);
  }
}

}  // namespace motor_branches_test
}  // namespace equipoise
