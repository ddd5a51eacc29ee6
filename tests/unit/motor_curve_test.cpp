// Motors by points of their curve and by nameplate, loads, gears and run-up times: what a data sheet says of a drive.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/drives/motor.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/study/contents/study.hpp"
#include "../support/refusals.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace motor_curve_test {

using model::DriveSegment;
using model::Load;
using model::MotorLaw;

constexpr double rpm = two_pi / 60.0;

DriveSegment curve(std::vector<double> speeds, std::vector<double> torques, Load load = {}) {
  MotorLaw law;
  law.kind = MotorLaw::Kind::curve;
  law.speeds = std::move(speeds);
  law.values = std::move(torques);
  law.load = load;
  return model::drive_segments(law).front();
}

TEST(MotorCurve, IsLinearBetweenItsPoints) {
  const DriveSegment motor = curve({0.0, 1.2, 1.44, 1.5}, {40.0, 95.0, 60.0, 0.0});
  const auto torque = [&](double speed) { return motor.torque(0.0, speed, 0.0); };
  EXPECT_EQ(torque(-1.0), 40.0);
  EXPECT_EQ(torque(0.0), 40.0);
  EXPECT_NEAR(torque(0.6), 67.5, 1e-12);
  EXPECT_NEAR(torque(1.2), 95.0, 1e-12);
  EXPECT_NEAR(torque(1.44), 60.0, 1e-12);
  EXPECT_NEAR(torque(1.47), 30.0, 1e-12);
  EXPECT_NEAR(torque(1.53), -30.0, 1e-11);  // the last line goes on: a motor that is overdriven brakes
  EXPECT_NEAR(*motor.even_speed(0.0), 1.5, 1e-12);
}

TEST(MotorCurve, MirroredTurnsTheOtherWay) {
  const DriveSegment motor = curve({0.0, 1.2, 1.44, 1.5}, {40.0, 95.0, 60.0, 0.0}, {1.0, 2.0, 3.0}),
                     other = motor.mirrored();
  for (double speed = -2.0; speed <= 2.0; speed += 0.01)
    EXPECT_NEAR(other.torque(0.0, speed, 0.0), -motor.torque(0.0, -speed, 0.0), 1e-11) << speed;
  EXPECT_NEAR(*other.even_speed(0.1), -*motor.even_speed(0.1), 1e-12);
}

// Every crossing found by walking along the speed; the fastest at which the torque falls is meant.
TEST(MotorCurve, ComesToWhereTorqueAndLoadAreEven) {
  for (const Load load : {Load{0.0, 0.0, 20.0}, Load{30.0, 0.0, 0.0}, Load{10.0, 10.0, 5.0}, Load{45.0, 0.0, 0.0}}) {
    for (const double damping : {0.0, 1.0}) {
      const DriveSegment motor = curve({0.0, 0.4, 1.2, 1.44, 1.5}, {50.0, 42.0, 95.0, 60.0, 0.0}, load);
      double expected = -1.0;
      constexpr double step = 1e-5;
      const auto net = [&](double speed) { return motor.torque(0.0, speed, 0.0) - damping * speed; };
      for (double speed = 0.0; speed < 2.0; speed += step)
        if (net(speed) > 0.0 && net(speed + step) <= 0.0) expected = speed;
      ASSERT_GT(expected, 0.0);
      EXPECT_NEAR(*motor.even_speed(damping), expected, 2.0 * step);
    }
  }
  // Too much load at rest and no way past: the machine stays where the constant part is not yet whole.
  const double creeps = *curve({0.0, 1.0}, {1.0, 0.5}, {2.0, 0.0, 0.0}).even_speed(0.0);
  EXPECT_GT(creeps, 0.0);
  EXPECT_LT(creeps, Load::creeping);
  EXPECT_FALSE(curve({0.0, 1.0}, {1.0, 2.0}).even_speed(0.0));  // rises for ever
}

TEST(MotorCurve, AConstantTorqueAgainstAFanHoldsASpeed) {
  const Study study = parse_study(with(constant_speed, "damping = 0.5", "damping = 0.5\ninertia = 0.5"), "fan",
                                  {"speed={profile='torque', torque={constant=0.1}, load={quadratic=0.4, at=4.0}}"});
  const model::System system = study.system();
  EXPECT_NEAR(*model::sustained_speed(system), 2.0, 1e-12);  // 0.1 = 0.4 (w/4)^2
  EXPECT_FALSE(model::speeds_up_for_ever(system));
  EXPECT_FALSE(system.coasts());
  EXPECT_NEAR(study.speed_profile().final_speed(), 2.0, 1e-12);
}

TEST(Load, ActsAgainstTheRotationAndNotAtRest) {
  const Load load{2.0, 3.0, 4.0};
  EXPECT_EQ(load(0.0), 0.0);
  EXPECT_NEAR(load(2.0), 2.0 + 6.0 + 16.0, 1e-12);
  EXPECT_NEAR(load(-2.0), -(2.0 + 6.0 + 16.0), 1e-12);
  for (const double speed : {-1.5, -0.3, 0.004, 0.5, 2.0}) {
    constexpr double h = 1e-6;
    EXPECT_NEAR(load.slope(speed), (load(speed + h) - load(speed - h)) / (2.0 * h), 1e-6) << speed;
  }
}

TEST(Nameplate, HasItsRatedBreakdownAndLockedRotorTorque) {
  // 1.5 kW, four poles: a catalogue's usual figures.
  const model::Nameplate motor{9.95, 1440.0 * rpm, 1500.0 * rpm, 2.8, 2.4};
  EXPECT_NEAR(model::nameplate_torque(motor, motor.rated_speed), 9.95, 1e-12);
  EXPECT_NEAR(model::nameplate_torque(motor, 0.0), 2.4 * 9.95, 1e-12);
  EXPECT_NEAR(model::nameplate_torque(motor, motor.synchronous_speed), 0.0, 1e-12);
  const double top = model::breakdown_slip(motor);
  EXPECT_NEAR(model::nameplate_torque(motor, (1.0 - top) * motor.synchronous_speed), 2.8 * 9.95, 1e-12);
  // Kloss's formula in its usual form, by another way: s/s_b and s_b/s.
  for (const double slip : {0.01, 0.03, 0.1}) {
    const double kloss = 2.0 * 2.8 * 9.95 / (slip / top + top / slip);
    EXPECT_NEAR(model::nameplate_torque(motor, (1.0 - slip) * motor.synchronous_speed), kloss, 1e-12);
  }
  // No speed gives more than the breakdown torque, whatever the torque at rest. It was up to 13 % more once.
  for (const double at_rest : {0.1, 0.7, 1.5, 2.4, 2.7, 2.8}) {
    const model::Nameplate other{9.95, 1440.0 * rpm, 1500.0 * rpm, 2.8, at_rest};
    double most = 0.0, least = 1e9;
    for (int i = 0; i <= 10000; ++i) {
      const double torque = model::nameplate_torque(other, other.synchronous_speed * i / 10000.0);
      most = std::max(most, torque);
      if (i < 9000) least = std::min(least, torque);
    }
    EXPECT_LE(most, 2.8 * 9.95 * (1.0 + 1e-12)) << at_rest;
    EXPECT_GT(least, 0.0) << at_rest;
  }
  const model::CurvePoints points = model::nameplate_curve(motor);
  const DriveSegment chords = curve(points.speeds, points.torques);
  double off = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const double speed = motor.synchronous_speed * i / 1000.0;
    off = std::max(off, std::fabs(chords.torque(0.0, speed, 0.0) - model::nameplate_torque(motor, speed)));
  }
  EXPECT_LT(off, 0.01 * 2.8 * 9.95);
}

TEST(Nameplate, KnowsSpeedsWithoutSlip) {
  const auto rounded = [](double rated) {
    std::vector<double> speeds = model::synchronous_speeds(rated * rpm);
    for (double& speed : speeds) speed = std::round(speed / rpm);
    return speeds;
  };
  EXPECT_EQ(rounded(1440.0), (std::vector{1500.0}));
  EXPECT_EQ(rounded(2850.0), (std::vector{3000.0}));
  EXPECT_EQ(rounded(1750.0), (std::vector{1800.0}));
  EXPECT_EQ(rounded(700.0), (std::vector{720.0, 750.0}));
  EXPECT_TRUE(rounded(2000.0).empty());
}

const std::string fan = R"(
[rotor]
mass = "30 kg"
stiffness = "400 kN/m"
damping_ratio = 0.05
unbalance = "600 g mm"
inertia = "0.8 kg m2"
[balancer]
balls = 2
race_radius = "120 mm"
mass = "30 g"
drag = "1e-4 N m s"
)";

Study machine(const std::string& speed) { return parse_study(fan + speed, "fan"); }

TEST(DriveSheet, NameplateGearAndMotorInertiaAreSeenFromTheRotorsShaft) {
  const std::string plate =
      "torque = { power = \"1.5 kW\", rated_speed = \"1440 rpm\", breakdown_ratio = 2.8, locked_rotor_ratio = 2.4 }\n";
  const Study plain = machine("[speed]\n" + plate);
  ASSERT_TRUE(plain.speed.driven());
  const double rated = 1500.0 / (1440.0 * rpm);
  const auto& unit = *plain.scales;
  const auto torque_of = [](const Study& s, double si_speed) {
    return model::drive_segments(s.motor()).front().torque(0.0, si_speed / s.scales->frequency, 0.0) *
           s.scales->torque();
  };
  EXPECT_NEAR(torque_of(plain, 1440.0 * rpm), rated, 0.02 * rated);
  EXPECT_NEAR(torque_of(plain, 0.0), 2.4 * rated, 1e-9);
  EXPECT_NEAR(*plain.motor().final_speed() * unit.frequency, 1500.0 * rpm, 1e-9);
  const Study geared = machine("[speed]\ngear_ratio = 2.5\nmotor_inertia = \"0.004 kg m2\"\n" + plate);
  EXPECT_NEAR(torque_of(geared, 0.0), 2.5 * 2.4 * rated, 1e-9);
  EXPECT_NEAR(*geared.motor().final_speed() * unit.frequency, 1500.0 / 2.5 * rpm, 1e-9);
  EXPECT_NEAR((geared.parameters.inertia - plain.parameters.inertia) * unit.inertia(), 2.5 * 2.5 * 0.004, 1e-12);
  // Control gains go with the square: torque times the ratio for a speed over it.
  const std::string control =
      "torque = { gain = \"2 N m s\", target = { profile = \"constant\", speed = \"1000 rpm\" } }\n";
  const Study controlled = machine("[speed]\ngear_ratio = 2.5\n" + control);
  EXPECT_NEAR(controlled.speed.torque.gain * unit.gain(), 2.0 * 2.5 * 2.5, 1e-12);
  EXPECT_NEAR(controlled.speed.torque.target.speed * unit.frequency, 400.0 * rpm, 1e-9);
}

TEST(DriveSheet, ARunUpTimeIsARampWithFreeBalls) {
  const Study study = machine("[speed]\nfinal = \"1200 rpm\"\nrun_up = \"12 s\"\n");
  EXPECT_EQ(study.speed.profile, Profile::ramp);
  EXPECT_NEAR(study.speed.duration * study.scales->time(), 12.0, 1e-12);
  EXPECT_EQ(study.release.time, 0.0);
  EXPECT_EQ(machine("[speed]\nspeed = \"1200 rpm\"\n").speed.profile, Profile::constant);
}

TEST(DriveSheet, UncertainFiguresAreDrawn) {
  const Study study = machine("[speed]\nrun_up = { uniform = [\"8 s\", \"16 s\"] }\nfinal = \"1200 rpm\"\n");
  EXPECT_NEAR(study.speed.duration * study.scales->time(), 12.0, 1e-12);
  const Study drawn = drawn_study(study, std::vector{9.0});
  EXPECT_NEAR(drawn.speed.duration * study.scales->time(), 9.0, 1e-12);
  const Study motor = machine(
      "[speed]\ngear_ratio = { values = [1.0, 2.0] }\ntorque = { stall = \"20 N m\", no_load_speed = \"3000 rpm\" }\n");
  EXPECT_NEAR(drawn_study(motor, std::vector{2.0}).speed.torque.stall * motor.scales->torque(), 40.0, 1e-9);
  // What a result carries reads back as the same study.
  EXPECT_EQ(to_toml(parse_study(to_toml(motor), "again")), to_toml(motor));
}

TEST(DriveSheet, RefusesWhatContradictsItself) {
  const auto problem = [](const std::string& speed) { return refused([&] { machine("[speed]\n" + speed); }); };
  const std::string plate = "power = \"1.5 kW\", rated_speed = \"1440 rpm\", breakdown_ratio = 2.8";
  EXPECT_EQ(problem("torque = { " + plate + ", stall = \"3 N m\" }").key(), "speed.torque.stall");
  EXPECT_EQ(problem("torque = { " + plate + ", rated_torque = \"20 N m\" }").key(), "speed.torque.rated_torque");
  EXPECT_EQ(problem("torque = { power = \"1.5 kW\", rated_speed = \"700 rpm\", breakdown_ratio = 2.8 }").key(),
            "speed.torque.rated_speed");
  EXPECT_EQ(problem("torque = { power = \"1.5 kW\", rated_speed = \"1440 rpm\" }").key(),
            "speed.torque.breakdown_ratio");
  EXPECT_EQ(problem("torque = { breakdown_ratio = 2.0 }").key(), "speed.torque.breakdown_ratio");
  EXPECT_EQ(problem("profile = \"constant\"\nspeed = \"900 rpm\"\nrun_up = \"3 s\"").key(), "speed.run_up");
  EXPECT_EQ(problem("final = \"900 rpm\"\nrun_up = \"-3 s\"").key(), "speed.run_up");
  EXPECT_EQ(problem("run_up = \"3 s\"").key(), "speed.final");
  EXPECT_EQ(problem("final = \"900 rpm\"\nrun_up = \"3 s\"\ngear_ratio = 2.0").key(), "speed.gear_ratio");
  EXPECT_EQ(problem("torque = { speeds = [\"0 rpm\", \"0 rpm\"], values = [\"1 N m\", \"0 N m\"] }").key(),
            "speed.torque.speeds");
  EXPECT_EQ(problem("torque = { speeds = [\"0 rpm\", \"90 rpm\"], values = [\"1 N m\"] }").key(),
            "speed.torque.values");
  EXPECT_EQ(problem("load = { quadratic = \"3 N m\" }\ntorque = { constant = \"3 N m\" }").key(), "speed.load.at");
  EXPECT_EQ(problem("load = { constant = \"-3 N m\" }\ntorque = { constant = \"3 N m\" }").key(),
            "speed.load.constant");
}

}  // namespace motor_curve_test
}  // namespace equipoise
