// Balls that hang below the shaft: the speed from which drag carries them round, against trajectories on either side.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/machine/balance/carrying.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "../support/explained.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace carrying_test {

// m g R/(D omega) = 1 at beta = 0.04. The run-up is slow, so that balls follow the bottom of their well.
const std::string slow = R"([rotor]
eccentricity = 0.001
damping = 0.1
gravity = 0.2
[balancer]
balls = 2
mass = 0.002
drag = 0.04
[speed]
profile = "ramp"
initial = 0.0
final = 5.0
duration = 300.0
[release]
time = 0.0
[initial]
phi = [0.5, 3.0]
)";

Study study_of(const std::string& text, const std::vector<std::string>& overrides) {
  Study study = parse_study(text, "m.toml", overrides);
  study.numerics.tolerance = 1e-8;
  return study;
}

// Balls that turn in fixed axes by more than half of what the rotor does.
int carried_in(const Study& study, double from, double to) {
  const Trajectory run = simulate(study, {from, to});
  const double turned = run.psi[1] - run.psi[0];
  int count = 0;
  for (const std::vector<double>& phi : run.phi) count += phi[1] - phi[0] + turned > 0.5 * turned;
  return count;
}

struct Case {
  std::vector<std::string> overrides;
  double all;  // times G/(0.04), the speed from which all are carried
};

TEST(Carrying, HoldsForTrajectoriesBelowAndAbove) {
  const double row = std::sin(1.0) / (4.0 * std::sin(0.25));
  const std::vector<Case> cases{
      {{}, 1.0},
      {{"rotor.eccentricity=0.02", "rotor.damping=0.4"}, 1.0},
      {{"balancer.race_offset=[0.02,0.01]"}, 1.0},
      {{"balancer.rolls=true", "balancer.ball_radius=0.1"}, 1.0},
      {{"balancer.rolling=0.002"}, 1.0},
      {{"balancer.mass=[0.002,0.004]"}, 1.0},
      {{"balancer.balls=4", "balancer.contact_angle=0.5", "initial.phi=[0.3,1.9,3.4,5.0]"}, row},
  };
  for (const Case& c : cases) {
    const double threshold = 5.0 * c.all;
    for (const double factor : {0.96, 1.03}) {
      std::vector<std::string> overrides = c.overrides;
      overrides.push_back("speed.final=" + std::to_string(factor * threshold));
      const Study study = study_of(slow, overrides);
      const auto told = carrying(study);
      ASSERT_TRUE(told);
      EXPECT_NEAR(told->all, threshold, 1e-5 * threshold);
      EXPECT_EQ(told->may_hang(), factor < 1.0);
      EXPECT_EQ(hanging_text(study).empty(), factor > 1.0);
      EXPECT_EQ(carried_in(study, 900.0, 1000.0), factor < 1.0 ? 0 : study.parameters.balls)
          << testing::PrintToString(overrides);
    }
  }
}

TEST(Carrying, TellsBallsOfUnlikeDragApart) {
  const Study study = study_of(slow, {"balancer.drag=[0.03,0.05]"});
  const auto told = carrying(study);
  ASSERT_TRUE(told);
  EXPECT_NEAR(told->first, 4.0, 1e-12);
  EXPECT_NEAR(told->all, 0.2 / 0.03, 1e-12);
  EXPECT_TRUE(holds(hanging_text(study), "the first of hanging balls round from 4 on, all from 6.6667 on"));
  EXPECT_EQ(carried_in(study, 900.0, 1000.0), 1);
  // Without drag nothing carries a ball.
  EXPECT_TRUE(holds(hanging_text(study_of(slow, {"balancer.drag=[0.0,0.05]"})), "without drag are never carried"));
}

// They turn with nothing, so what turns with the rotor is its own unbalance.
TEST(Carrying, HangingBallsLeaveTheRotorsOwnUnbalance) {
  BasinOptions options;
  options.transients = true;
  const BasinResult r = basin(study_of(slow, {"speed.final=4.0", "sampling.starts=8"}), options);
  const SampleSummary& left = r.transients->groups.front().figure(&TransientRow::residual_unbalance);
  EXPECT_EQ(left.count, 8u);
  EXPECT_NEAR(left.largest, 0.001, 1e-5);
  EXPECT_NEAR(left.mean, 0.001, 1e-5);
}

// Let go of a turning rotor, no ball falls though drag is too little; slowly turning ones fall.
TEST(Carrying, KnowsBallsThatAreLetGoTurning) {
  const std::string constant = with(slow, R"(profile = "ramp"
initial = 0.0
final = 5.0
duration = 300.0
)",
                                    "profile = \"constant\"\nspeed = 5.0\n");
  for (const double speed : {0.8, 1.5, 5.0}) {  // 2 sqrt(G) = 0.894
    const Study study = study_of(
        constant, {"speed.speed=" + std::to_string(speed), "balancer.drag=0.01", "initial.phi=[-1.5707963,-1.5]"});
    ASSERT_TRUE(carrying(study));
    EXPECT_EQ(carrying(study)->turning, speed > 0.9);
    EXPECT_EQ(hanging_text(study).empty(), speed > 0.9);
    EXPECT_EQ(carried_in(study, 900.0, 1000.0), speed > 0.9 ? 2 : 0) << speed;
  }
  EXPECT_TRUE(carrying(study_of(slow, {"balancer.drag=0.01", "release.time=300.0"}))->turning);
  EXPECT_FALSE(carrying(study_of(slow, {"balancer.drag=0.01", "release.time=30.0"}))->turning);
  EXPECT_FALSE(carrying(study_of(slow, {"rotor.gravity=0.0"})));
  EXPECT_FALSE(carrying(study_of(slow, {"balancer.balls=0"})));
}

// Balls that hang brake the motor by n D omega, so that the speed which would carry them may never be reached.
TEST(Carrying, CountsWhatHangingBallsTakeOfAMotor) {
  const std::string driven = with(with(slow, "mass = 0.002", "mass = 0.05"), R"(profile = "ramp"
initial = 0.0
final = 5.0
duration = 300.0
)",
                                  "profile = \"torque\"\n");
  for (const bool weak : {true, false}) {
    const Study study = study_of(driven, {"rotor.inertia=0.5", std::string("speed.torque={stall=") +
                                                                   (weak ? "0.012" : "0.2") + ",no_load_speed=6.0}"});
    const auto told = carrying(study);
    ASSERT_TRUE(told);
    EXPECT_NEAR(told->all, 5.0, 1e-12);
    if (weak) {
      EXPECT_NEAR(told->reached, 2.0, 1e-9);  // 0.012 - 0.002 omega = 0.004 omega
    }
    EXPECT_EQ(told->may_hang(), weak);
    EXPECT_EQ(carried_in(study, 1900.0, 2000.0), weak ? 0 : 2);
    EXPECT_NEAR(simulate(study, {2000.0}).psi_dot.back(), weak ? 2.0 : 6.0, 0.02);
  }
}

TEST(Carrying, HoldsForATiltingRotor) {
  const std::string tilting = with(slow, "[balancer]", R"([rotor.tilt]
transverse_inertia = 0.6
polar_inertia = 0.3
stiffness = [0.0, 1.0]
damping = [0.0, 0.1]
misalignment = 0.001
[balancer]
plane = [0.5, -0.5]
)");
  for (const double speed : {4.8, 5.15}) {
    const Study study = study_of(tilting, {"speed.final=" + std::to_string(speed)});
    EXPECT_NEAR(carrying(study)->all, 5.0, 1e-12);
    EXPECT_EQ(hanging_text(study).empty(), speed > 5.0);
    EXPECT_EQ(carried_in(study, 900.0, 1000.0), speed < 5.0 ? 0 : 2) << speed;
  }
}

// A blower whose oil carries its balls at 30 degC and does not at 40.
const std::string blower = R"([rotor]
mass = "185 kg"
static_sag = "25 mm"
damping_ratio = "2 %"
balance_grade = { grade = "G 6.3", at = "1480 rpm" }
gravity = "9.81 m/s2"
[[place]]
mass = "40 g"
radius = "315 mm"
angle = "0 degree"
[balancer]
balls = 4
race_radius = "120 mm"
ball_diameter = "25 mm"
ball_material = "steel"
oil = { grade = "ISO VG 150", at = "30 degC" }
[speed]
final = "1480 rpm"
run_up = "90 s"
)";

TEST(Carrying, IsToldAndWarnedOf) {
  for (const bool warm : {false, true}) {
    const std::vector<std::string> overrides{std::string("balancer.oil.at=") + (warm ? "40" : "30") + " degC"};
    const Explanation e = explained(blower, overrides);
    EXPECT_EQ(warned(e,
                     "balls that hang below the shaft at the final speed stay there and balance nothing, unless "
                     "vibration frees them"),
              warm);
    EXPECT_EQ(rule(e, "carried").kept, !warm);
    EXPECT_TRUE(holds(explain_text(e), warm ? "drag carries hanging balls round from 1578" : "from 864"));
    const StudyCheck check = check_study(blower, "m.toml", overrides);
    EXPECT_TRUE(
        holds(check.balls, warm ? "balls that hang below the shaft" : "; drag carries hanging balls round from 864"))
        << check.balls;
    EXPECT_TRUE(
        holds(check.most, warm ? "ball drag, here from a formula. With 20 % more, drag carries hanging balls round"
                               : "oil temperature. With 10 K more, balls stay hanging"))
        << check.most;
  }
  // Upright nothing is said.
  const Explanation upright = explained(with(blower, "gravity = \"9.81 m/s2\"\n", ""));
  EXPECT_FALSE(upright.carrying);
  EXPECT_FALSE(holds(explain_text(upright), "hanging"));
}

}  // namespace carrying_test
}  // namespace equipoise
