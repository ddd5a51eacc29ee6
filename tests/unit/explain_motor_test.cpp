// What an explained study says of motors: final speed, run-up time, torque that never ends; against trajectories.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "../support/studies.hpp"
#include "../support/explained.hpp"

namespace equipoise {
namespace explain_motor_test {

Explanation driven(const std::string& torque, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"speed={profile='torque'}", "rotor.inertia=0.5", "speed.torque=" + torque});
  return explained(constant_speed, more);
}

double speed_at(const Explanation& e, double time) { return simulate(e.study, {0.0, time}).psi_dot.back(); }

TEST(ExplainedMotor, RunUpIsThatOfTheTrajectory) {
  // Hardly any unbalance, and balls that drag pulls along: nothing is neglected.
  const std::vector<std::string> smooth{"rotor.eccentricity=1e-5", "balancer.mass=0.0005", "balancer.drag=2"};
  for (const char* torque : {"{stall=0.01, no_load_speed=3.0}", "{times=[0, 50, 100], values=[0.01, 0.03, 0.0]}",
                             "{speeds=[0, 1.5, 2.5, 3], values=[0.01, 0.03, 0.02, 0.0]}", "{constant=0.01, until=80}",
                             "{gain=0.02, limit=0.01, target={profile='ramp', final=3.0, duration=50.0}}",
                             "{gain=0.02, integral=0.001, target={profile='constant', speed=3.0}}"}) {
    const Explanation e = driven(torque, smooth);
    ASSERT_TRUE(e.run_up && e.run_up->alone && e.run_up->shaken) << torque;
    // Balls pulled along by drag lag by 1/beta of a time of at least 50, and are a thousandth of the inertia.
    EXPECT_NEAR(speed_at(e, *e.run_up->alone), e.run_up->speed, 2e-3 * e.run_up->speed) << torque;
    EXPECT_NEAR(e.run_up->speed, 0.95 * *e.speed, 1e-12) << torque;
  }
}

TEST(ExplainedMotor, ALoadSetsTheFinalSpeed) {
  const Explanation e = driven("{stall=0.1, no_load_speed=3.0}", {"speed.load={quadratic=0.04, at=2.0}"});
  EXPECT_TRUE(holds(explain_text(e), "where the motor gives what the load takes: a balanced rotor needs no more"));
  EXPECT_TRUE(holds(explain_text(e), "left by motor and load at the critical speed"));
  Explanation alone = e;  // nothing to shake: the rotor comes to that speed
  alone.study.parameters.eccentricity = 1e-9;
  alone.study.parameters.mass.fill(1e-9);
  EXPECT_NEAR(speed_at(alone, 400.0), *e.speed, 1e-6);
  EXPECT_LT(*e.speed, 2.5);
  const Explanation off = driven("{stall=0.1, no_load_speed=3.0}",
                                 {"speed.load={quadratic=0.04, at=2.0}", "balancer.race_offset=[0.001, 0]"});
  EXPECT_TRUE(holds(explain_text(off), "where the motor gives what load and supports' dampers take in balance"));
  EXPECT_FALSE(holds(explain_text(driven("{stall=0.1, no_load_speed=3.0}")), "what the load takes"));
}

TEST(ExplainedMotor, RunUpKnowsWhatShakingTakes) {
  // 0.01^2 omega^3/0.1 = 0.00086 is absorbed at resonance: most of the 0.00102 that the first motor delivers there.
  const auto motor = [](const char* stall, const char* release) {
    return driven("{stall=" + std::string(stall) + ", no_load_speed=3.0}", {"rotor.damping=0.1", release});
  };
  const Explanation slow = motor("0.0015", "release.time=0");
  ASSERT_TRUE(slow.run_up->shaken);
  EXPECT_GT(*slow.run_up->shaken, 1.02 * *slow.run_up->alone);
  const Explanation weak = motor("0.0012", "release.time=1e6");
  EXPECT_FALSE(weak.run_up->shaken);
  EXPECT_TRUE(holds(explain_text(weak), "it stalls at"));
  EXPECT_FALSE(holds(explain_text(slow), "it stalls at"));
  // A trajectory with the balls held opposite each other, across the heavy side, stalls there too.
  Explanation held = weak;
  held.study.initial.phi = {0.5 * pi, -0.5 * pi};
  const double stalled = speed_at(held, 20000.0);
  EXPECT_LT(stalled, 1.0);
  EXPECT_NEAR(stalled, weak.run_up->stalls_at, 1e-3);  // it comes closer still, and swings about it once a turn
  EXPECT_TRUE(warned(weak, "the motor may be too weak for the critical speed"));
  EXPECT_TRUE(
      warned(slow, "may not suffice at the critical speed: whether it is enough depends on where the balls are"));
  EXPECT_FALSE(warned(driven("{stall=0.1, no_load_speed=3.0}"), "critical speed:"));
}

TEST(ExplainedMotor, ComparesRunUpAndHorizon) {
  const Explanation weak = driven("{stall=0.0003, no_load_speed=3.0}", {"numerics.horizon=10000"});
  EXPECT_GT(*weak.run_up->alone, 10000.0);
  EXPECT_TRUE(warned(weak, "longer than starts are followed, 10000: they may stay undecided"));
  EXPECT_LT(speed_at(weak, 10000.0), weak.run_up->speed);
  EXPECT_FALSE(warned(driven("{stall=0.0003, no_load_speed=3.0}", {"numerics.horizon=50000"}), "longer than starts"));
}

TEST(ExplainedMotor, TorqueThatNeverEndsHoldsNoSpeed) {
  for (const char* torque :
       {"{times=[0, 2, 4], values=[0.0005, 0.001, 0.0005]}", "{constant=0.0005}", "{constant=0.0005, slope=0.0001}"}) {
    const Explanation e = driven(torque);
    EXPECT_FALSE(e.speed.has_value()) << torque;
    EXPECT_TRUE(warned(e, "in balance the rotor speeds up without end")) << torque;
    EXPECT_TRUE(holds(study_heading(e.study), "the last torque never ends")) << torque;
    EXPECT_TRUE(holds(e.no_motion, "no speed is held")) << torque;
    EXPECT_TRUE(holds(verdict_text(e), "the balls have the mass and the room, but the motor's last torque never ends"))
        << torque;
    // A rotor that begins in balance, with two equal balls.
    Explanation balanced = e;
    const double phi = std::acos(-0.01 / (2.0 * 0.05));
    balanced.study.initial.phi = {phi, -phi};
    balanced.study.speed.initial = 3.0;
    const double sooner = speed_at(balanced, 1000.0), later = speed_at(balanced, 3000.0);
    EXPECT_GT(sooner, 3.5) << torque;
    EXPECT_GT(later, sooner + 1.0) << torque;
  }
  // Torque that ends, falls with speed, or is absorbed by the damper of an off-centre race.
  for (const char* torque :
       {"{times=[0, 2, 4], values=[0.2, 0.3, 0.0]}", "{constant=0.05, slope=-0.01}", "{constant=0.05, until=20}"}) {
    const Explanation e = driven(torque);
    EXPECT_TRUE(e.speed.has_value()) << torque;
    EXPECT_FALSE(warned(e, "without end")) << torque;
    EXPECT_FALSE(holds(study_heading(e.study), "for ever")) << torque;
  }
  EXPECT_FALSE(driven("{constant=0.05}", {"balancer.race_offset=[0.1,0]"}).speeds_up);
}

TEST(ExplainedMotor, KnowsTheSpeedThatABalancedRotorComesTo) {
  // Torque 0.03 - 0.01 psi' vanishes at 3, and the balanced rotor, once settled, turns at that speed.
  const Explanation e = driven("{constant=0.3, slope=-0.1}");
  EXPECT_DOUBLE_EQ(*e.speed, 3.0);
  EXPECT_TRUE(holds(explain_text(e), "where the motor's torque vanishes: a balanced rotor needs none"));
  EXPECT_TRUE(e.motion.has_value());
  Explanation balanced = e;
  balanced.study.initial.phi = e.motion->angles;
  balanced.study.speed.initial = 2.9;
  EXPECT_NEAR(speed_at(balanced, 400.0), 3.0, 1e-3);
  // A motor that lets go leaves the rotor at its speed, if nothing else has braked it.
  const Explanation coasts = driven("{constant=0.02, until=100}", {"rotor.eccentricity=1e-5", "balancer.mass=0.0005"});
  EXPECT_NEAR(*coasts.speed, 0.02 * 100.0 / (0.5 + 0.001), 1e-6);
  EXPECT_NEAR(speed_at(coasts, 200.0), *coasts.speed, 5e-3 * *coasts.speed);  // balls of 0.2 % lag a little
  EXPECT_TRUE(holds(explain_text(coasts), "when its motor lets go if nothing has braked it"));
  EXPECT_TRUE(coasts.motion.has_value());
  // A torque that acts for a limited time must bring the rotor through within it.
  EXPECT_EQ(rule(driven("{constant=0.05, until=1}"), "torque").words, "the final speed is below the critical speed");
  EXPECT_EQ(rule(driven("{times=[0, 60, 61], values=[0.05, 0.05, 0]}"), "torque").kept, true);
  EXPECT_EQ(rule(driven("{stall=0.1, no_load_speed=3}", {"speed.initial=2"}), "torque").words,
            "the rotor is above the critical speed from the beginning");
}

TEST(ExplainedMotor, JsonHasTheRunUp) {
  const auto json = nlohmann::json::parse(json_text(driven("{stall=0.01, no_load_speed=3.0}")));
  EXPECT_GT(json["run_up"]["with_own_unbalance"]["dimensionless"], json["run_up"]["without_losses"]["dimensionless"]);
  EXPECT_TRUE(json["run_up"]["stalls_at"].is_null());
  EXPECT_TRUE(nlohmann::json::parse(json_text(explained(constant_speed)))["run_up"].is_null());
  EXPECT_FALSE(holds(explain_text(explained(constant_speed)), "run-up"));
}

}  // namespace explain_motor_test
}  // namespace equipoise
