// Studies in physical units: conversion of each key, refusals with their words, and the way back.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/study/echo/physical_echo.hpp"
#include "equipoise/study/contents/study.hpp"
#include "../support/studies.hpp"
#include "../support/study_difference.hpp"

namespace equipoise {
namespace physical_study_test {

const std::string& machine = ramp_machine;
const double omega_c = std::sqrt(48000.0 / 12.0);

std::string with(const std::string& from, const std::string& to) { return equipoise::with(machine, from, to); }

Study parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_study(text, "m.toml", overrides);
}

TEST(PhysicalStudy, BecomesTheDimensionlessOneOfTheTextbook) {
  const Study s = parse(machine);
  ASSERT_TRUE(s.scales.has_value());
  EXPECT_DOUBLE_EQ(s.scales->mass, 12.0);
  EXPECT_DOUBLE_EQ(s.scales->length, 0.03);
  EXPECT_DOUBLE_EQ(s.scales->frequency, omega_c);
  EXPECT_DOUBLE_EQ(s.parameters.eccentricity, 0.2 / 30.0);
  EXPECT_DOUBLE_EQ(s.parameters.damping[0], 400.0 / std::sqrt(48000.0 * 12.0));
  EXPECT_EQ(s.parameters.damping[1], s.parameters.damping[0]);
  EXPECT_EQ(s.parameters.stiffness, (std::array<double, 2>{1.0, 1.0}));
  EXPECT_DOUBLE_EQ(s.parameters.mass[1], 0.06 / 12.0);
  EXPECT_DOUBLE_EQ(s.parameters.drag[1], 2e-4 / (0.06 * 0.03 * 0.03 * omega_c));
  EXPECT_DOUBLE_EQ(s.speed.final, 100.0 * pi / omega_c);
  EXPECT_DOUBLE_EQ(s.speed.duration, 10.0 * omega_c);
  EXPECT_EQ(s.speed.initial, 0.0);
  EXPECT_FALSE(s.numerics.horizon);
}

TEST(PhysicalStudy, SaysOneThingInSeveralWays) {
  const auto same = [](const Study& a, const Study& b) {
    EXPECT_NEAR(a.parameters.eccentricity, b.parameters.eccentricity, 1e-15);  // of order 1e-2: roundings
    for (int i = 0; i < 2; ++i) {
      EXPECT_DOUBLE_EQ(a.parameters.damping[i], b.parameters.damping[i]);
      EXPECT_DOUBLE_EQ(a.parameters.mass[i], b.parameters.mass[i]);
      EXPECT_DOUBLE_EQ(a.parameters.drag[i], b.parameters.drag[i]);
    }
  };
  const Study base = parse(machine);
  same(base, parse(with("eccentricity = \"0.2 mm\"", "unbalance = \"2400 g mm\"")));
  same(base, parse(with("damping = \"400 N s/m\"",
                        fmt::format("damping_ratio = {}", 400.0 / (2.0 * std::sqrt(48000.0 * 12.0))))));
  same(base, parse(with("drag = \"2e-4 N m s\"", fmt::format("drag = \"{} N s/m\"", 2e-4 / (0.03 * 0.03)))));
  const double density = 0.06 / (pi / 6.0 * 1e-6);
  same(base,
       parse(with("mass = \"60 g\"", fmt::format("ball_diameter = \"10 mm\"\nball_density = \"{} kg/m3\"", density))));
}

TEST(PhysicalStudy, TakesTheMeanOfTwoStiffnessesForTheCriticalSpeed) {
  const Study s = parse(with("stiffness = \"48 kN/m\"\ndamping = \"400 N s/m\"",
                             "stiffness = [\"40 kN/m\", \"56 kN/m\"]\ndamping_ratio = [0.1, 0.2]"));
  EXPECT_DOUBLE_EQ(s.scales->frequency, omega_c);
  EXPECT_DOUBLE_EQ(s.parameters.stiffness[0], 40.0 / 48.0);
  EXPECT_DOUBLE_EQ(s.parameters.stiffness[1], 56.0 / 48.0);
  // c = 2 d sqrt(k_x M), over M omega_c.
  EXPECT_DOUBLE_EQ(s.parameters.damping[0], 0.2 * std::sqrt(40000.0 * 12.0) / (12.0 * omega_c));
  EXPECT_DOUBLE_EQ(s.parameters.damping[1], 0.4 * std::sqrt(56000.0 * 12.0) / (12.0 * omega_c));
}

TEST(PhysicalStudy, TakesTheDragOfOil) {
  const std::string oil = "ball_diameter = \"8 mm\"\noil_viscosity = \"100 mPa s\"\n";
  const double stokes = 3.0 * pi * 0.1 * 8e-3;  // N s/m
  const double beta = stokes / (0.06 * omega_c);
  EXPECT_DOUBLE_EQ(parse(with("drag = \"2e-4 N m s\"\n", oil)).parameters.drag[0], beta);
  const std::string thin = "ball_diameter = \"8 mm\"\noil_viscosity = \"100 cSt\"\noil_density = \"1000 kg/m3\"\n";
  EXPECT_DOUBLE_EQ(parse(with("drag = \"2e-4 N m s\"\n", thin)).parameters.drag[0], beta);
  // A ball half as wide as the channel: the exact factor is 5.9474; the formula is within 0.2 % of exact ones.
  const Study narrow = parse(with("drag = \"2e-4 N m s\"\n", oil + "channel_diameter = \"16 mm\"\n"));
  EXPECT_NEAR(narrow.parameters.drag[0], 5.9474 * beta, 0.002 * 5.9474 * beta);
}

TEST(PhysicalStudy, ConvertsEveryKeyOfTheOtherTables) {
  const Study s = parse(with("profile = \"ramp\"\nfinal = \"3000 rpm\"\nduration = \"10 s\"",
                             R"(profile = "points"
times = ["0 s", "1 s", "500 ms"]
speeds = ["0 rpm", "10 Hz", "100 rad/s"]
[release]
time = "0 s"
[initial]
psi = "30 degree"
x = "1 mm"
y = "-2 mm"
x_dot = "3 mm/s"
y_dot = "4 mm/s"
phi = [1.0, "90 degree"]
phi_dot = "-60 rpm"
[sampling.box]
x = ["-1 mm", "1 mm"]
phi_dot = ["-1 Hz", "1 Hz"]
[numerics]
horizon = "60 s"
[limits]
displacement = "2 mm"
force = "500 N"
velocity = "4.5 mm/s"
settled = "0.1 mm")"),
                        {"speed.times=['0 s', '500 ms', '1 s']"});
  const double turn = 2.0 * pi / omega_c;
  EXPECT_DOUBLE_EQ(s.speed.times[1], 0.5 * omega_c);
  EXPECT_DOUBLE_EQ(s.speed.speeds[1], 10.0 * turn);
  EXPECT_DOUBLE_EQ(s.speed.speeds[2], 100.0 / omega_c);
  EXPECT_EQ(s.release.time, 0.0);
  EXPECT_DOUBLE_EQ(s.initial.psi, pi / 6.0);
  EXPECT_DOUBLE_EQ(s.initial.x, 1.0 / 30.0);
  EXPECT_DOUBLE_EQ(s.initial.y, -2.0 / 30.0);
  EXPECT_DOUBLE_EQ(s.initial.x_dot, 3e-3 / (0.03 * omega_c));
  EXPECT_DOUBLE_EQ(s.initial.y_dot, 4e-3 / (0.03 * omega_c));
  EXPECT_EQ(s.initial.phi[0], 1.0);
  EXPECT_DOUBLE_EQ(s.initial.phi[1], pi / 2.0);
  EXPECT_DOUBLE_EQ(s.initial.phi_dot[1], -turn);
  EXPECT_DOUBLE_EQ(s.sampling.box.x->low, -1.0 / 30.0);
  EXPECT_DOUBLE_EQ(s.sampling.box.phi_dot->high, turn);
  EXPECT_DOUBLE_EQ(s.numerics.horizon.value(), 60.0 * omega_c);
  EXPECT_DOUBLE_EQ(*s.limits.displacement, 2.0 / 30.0);
  EXPECT_DOUBLE_EQ(*s.limits.force, 500.0 / (48000.0 * 0.03));
  EXPECT_DOUBLE_EQ(*s.limits.velocity, 4.5e-3 / (0.03 * omega_c));
  EXPECT_DOUBLE_EQ(*s.limits.settled, 0.1 / 30.0);
}

TEST(PhysicalStudy, ConvertsMotorContactAndOffset) {
  const Study s =
      parse(machine, {"rotor.inertia=0.0108 kg m2", "rotor.gravity=9.81 m/s2", "balancer.race_offset=['30 um', '0 um']",
                      "balancer.ball_diameter=8 mm", "balancer.contact=true", "balancer.rolling=0.001",
                      "speed={stalled_below='1500 rpm', torque={gain='0.1 N m s', integral='0.2 N m', "
                      "limit='5 N m', target={profile='ramp', final='3000 rpm', duration='5 s'}}}"});
  const double torque = 12.0 * 0.03 * 0.03 * omega_c * omega_c;
  EXPECT_DOUBLE_EQ(s.parameters.inertia, 1.0);
  EXPECT_DOUBLE_EQ(s.parameters.gravity, 9.81 / (0.03 * omega_c * omega_c));
  EXPECT_DOUBLE_EQ(s.parameters.race_offset[0], 0.001);
  EXPECT_DOUBLE_EQ(s.parameters.contact_angle, 2.0 * std::asin(4.0 / 30.0));
  EXPECT_EQ(s.parameters.rolling[0], 0.001);
  EXPECT_DOUBLE_EQ(*s.speed.stalled_below, 50.0 * pi / omega_c);
  EXPECT_DOUBLE_EQ(s.speed.torque.gain, 0.1 * omega_c / torque);
  // A constant error of one critical speed raises the torque by 0.2 * omega_c per second.
  EXPECT_DOUBLE_EQ(s.speed.torque.integral, 0.2 * omega_c / torque / omega_c);
  EXPECT_DOUBLE_EQ(*s.speed.torque.limit, 5.0 / torque);
  EXPECT_DOUBLE_EQ(s.speed.torque.target.duration, 5.0 * omega_c);
}

// What a machine states stands in SI units, and what was stated is known.
TEST(PhysicalStudy, KeepsItsMachineInSi) {
  const Study s = parse(machine, {"balancer.ball_diameter=8 mm"});
  ASSERT_TRUE(s.in_si);
  EXPECT_FALSE(s.in_si->scales);
  EXPECT_EQ(s.in_si->sheet.mass, 12.0);
  EXPECT_EQ(s.in_si->parameters.stiffness, (std::array{48000.0, 48000.0}));
  EXPECT_DOUBLE_EQ(s.in_si->speed.final, 100.0 * pi);
  EXPECT_TRUE(s.states("balancer.ball_diameter"));
  EXPECT_FALSE(s.states("balancer.rolls"));
  EXPECT_FALSE(s.states("release.time"));  // assumed
}

TEST(PhysicalStudy, BallsOfOneKnownSizeTouchUnlessToldOtherwise) {
  const std::string size = "balancer.ball_diameter=8 mm";
  const auto touching = [](const std::vector<std::string>& overrides) {
    return parse(machine, overrides).parameters.contact_angle;
  };
  const double side_by_side = 2.0 * std::asin(4.0 / 30.0);
  EXPECT_EQ(touching({}), 0.0);
  EXPECT_DOUBLE_EQ(touching({size}), side_by_side);
  EXPECT_DOUBLE_EQ(touching({size, "balancer.contact=true"}), side_by_side);
  EXPECT_EQ(touching({size, "balancer.contact=false"}), 0.0);
  EXPECT_EQ(touching({size, "balancer.contact_angle=0"}), 0.0);
  EXPECT_EQ(touching({size, "balancer.contact_angle=0.3"}), 0.3);
  EXPECT_EQ(touching({size, "balancer.balls=1"}), 0.0);
  EXPECT_EQ(touching({"balancer.ball_diameter=['8 mm', '9 mm']"}), 0.0);
}

TEST(PhysicalStudy, BallsWhoseSizeIsGivenRoll) {
  EXPECT_FALSE(parse(machine).parameters.rolls);
  const model::Parameters p = parse(machine, {"balancer.ball_diameter=['8 mm', '9 mm']"}).parameters;
  EXPECT_TRUE(p.rolls);
  EXPECT_DOUBLE_EQ(p.ball_radius[0], 4.0 / 30.0);
  EXPECT_DOUBLE_EQ(p.ball_radius[1], 4.5 / 30.0);
  EXPECT_FALSE(parse(machine, {"balancer.ball_diameter=8 mm", "balancer.rolls=false"}).parameters.rolls);
  EXPECT_DOUBLE_EQ(parse(machine, {"balancer.rolls=true", "balancer.ball_radius=4 mm"}).parameters.ball_radius[1],
                   4.0 / 30.0);
}

TEST(PhysicalStudy, ShippedExamplesAreRead) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(EQUIPOISE_SOURCE_DIR "/studies/examples")) {
    const Study s = read_study(entry.path().string());
    EXPECT_EQ(first_difference(s, parse(to_toml(s))), "") << entry.path();
    ++count;
  }
  EXPECT_GT(count, 0);
}

TEST(PhysicalStudy, TakesOverridesOfPhysicalKeys) {
  EXPECT_DOUBLE_EQ(parse(machine, {"rotor.mass=24 kg"}).scales->mass, 24.0);
  EXPECT_DOUBLE_EQ(parse(machine, {"speed.final=50 Hz"}).speed.final, 100.0 * pi / omega_c);
  EXPECT_DOUBLE_EQ(parse(machine, {"balancer.mass=['60 g', '50 g']"}).parameters.mass[1], 0.05 / 12.0);
}

const std::vector<std::string> spin_ups{
    "speed={profile='ramp', final='3000 rpm', duration='10 s'}",
    "speed={profile='trapezoid', peak='50 Hz', final='40 Hz', rise_until='8 s', hold_until='9 s', fall_until='12 s'}",
    "speed={profile='points', times=['0 s', '4 s'], speeds=['0 rpm', '2000 rpm']}"};

TEST(PhysicalStudy, LetsItsBallsRunFreeUnlessItSaysOtherwise) {
  for (const std::string& speed : spin_ups) {
    const Study s = parse(machine, {speed});
    EXPECT_EQ(s.release_time(), 0.0) << speed;
    EXPECT_EQ(parse(machine, {speed, "release={}"}).release_time(), 0.0) << speed;
    EXPECT_DOUBLE_EQ(parse(machine, {speed, "release.time=2 s"}).release_time(), 2.0 * omega_c) << speed;
    EXPECT_GT(parse(machine, {speed, "release.speed=1000 rpm"}).release_time(), 0.0) << speed;
    // A result carries the dimensionless study, which would hold the balls if it did not say otherwise.
    EXPECT_NE(to_toml(s).find("[release]\ntime = 0.0\n"), std::string::npos) << to_toml(s);
    EXPECT_EQ(parse(to_toml(s)).release_time(), 0.0) << speed;
    EXPECT_EQ(parse(to_physical_toml(s)).release_time(), 0.0) << speed;
  }
}

// Without units balls are held to the end of the ramp, and still are once units are written.
TEST(PhysicalEcho, OfADimensionlessStudyStatesItsRelease) {
  const std::string units = "[units]\nmass = 12.0\nlength = 0.03\nfrequency = 63.2\n";
  const Study held = parse(equipoise::with(ramp_speed, "500.0", "40.0") + units);
  EXPECT_EQ(held.release_time(), 40.0);
  EXPECT_NEAR(parse(to_physical_toml(held)).release_time(), 40.0, 1e-12);  // multiplied and divided by a scale
  const Study constant = parse(constant_speed + units);
  EXPECT_EQ(parse(to_physical_toml(constant)).release_time(), 0.0);
}

TEST(PhysicalStudy, ThatDrawsValuesStatesItsReleaseToo) {
  const std::string draws = "rotor.eccentricity={uniform=['0.1 mm', '0.3 mm']}";
  for (const std::string& speed : spin_ups) {
    const Study s = parse(machine, {speed, draws});
    EXPECT_EQ(s.release_time(), 0.0) << speed;
    EXPECT_NE(to_toml(s).find("[release]\ntime = \"0 s\"\n"), std::string::npos) << to_toml(s);
    EXPECT_EQ(drawn_study(s, std::vector{0.2}).release_time(), 0.0) << speed;
    EXPECT_NO_THROW(check(s));
  }
}

// Otherwise its result would be read as if the balls had run free.
TEST(PhysicalStudy, OfAnOlderResultHeldItsBalls) {
  std::string older = to_toml(parse(machine, {"rotor.eccentricity={uniform=['0.1 mm', '0.3 mm']}"}));
  const std::string release = "\n[release]\ntime = \"0 s\"\n";
  const std::string today = older;
  older.erase(older.find(release), release.size());
  EXPECT_DOUBLE_EQ(parse_kept_study(older, "older.nc").release_time(), 10.0 * omega_c);
  EXPECT_EQ(parse_kept_study(today, "today.nc").release_time(), 0.0);
}

TEST(Units, OfADimensionlessStudyAreKept) {
  const Study s = parse(constant_speed + "[limits]\nforce=0.5\n[units]\nmass=12\nlength=0.03\nfrequency=63.2\n");
  EXPECT_EQ(s.scales->frequency, 63.2);
  EXPECT_EQ(s.limits.force, 0.5);
  EXPECT_EQ(first_difference(s, parse(to_toml(s))), "");
}

TEST(Echo, OfAPhysicalStudyIsDimensionlessWithItsUnitsBitForBit) {
  const Study s = parse(machine, {"limits.force=500 N", "release.speed=1000 rpm"});
  const std::string echo = to_toml(s);
  EXPECT_NE(echo.find("[units]\nmass = 12.0\nlength = 0.03\n"), std::string::npos) << echo;
  EXPECT_EQ(first_difference(s, parse(echo)), "");
  EXPECT_EQ(to_toml(parse(echo)), echo);
}

TEST(PhysicalEcho, NeedsScales) {
  Study s = parse(machine);
  s.scales.reset();
  EXPECT_THROW(to_physical_toml(s), InputError);
}

TEST(PhysicalEcho, HoldsMotorContactAndOffset) {
  const Study a = parse(
      machine, {"rotor.inertia=0.0108 kg m2", "balancer.race_offset=['30 um', '-10 um']", "balancer.ball_diameter=8 mm",
                "balancer.contact=true", "speed={profile='torque', initial='100 rpm', stalled_below='1500 rpm'}",
                "speed.torque={gain='0.1 N m s', integral='0.2 N m', limit='5 N m', "
                "target={profile='ramp', final='3000 rpm', duration='5 s'}}"});
  EXPECT_EQ(first_difference(a, parse(to_toml(a))), "");
  const Study b = parse(to_physical_toml(a));
  EXPECT_EQ(first_difference(a, b, 1e-12), "");  // a handful of roundings
  const auto close = [](double u, double v) { EXPECT_NEAR(u, v, 1e-12 * std::abs(u)); };
  close(a.motor().gain, b.motor().gain);
  close(a.motor().integral, b.motor().integral);
  close(*a.motor().limit, *b.motor().limit);
  close(a.motor().aim.final_speed(), b.motor().aim.final_speed());
  close(a.motor().aim.settled_time(), b.motor().aim.settled_time());
}

// Physical, dimensionless, physical, dimensionless: products and quotients of a handful of factors, one rounding each.
TEST(PhysicalEcho, LeadsBackToTheSameMachine) {
  EXPECT_TRUE(rc::check("physical echo", [] {
    std::mt19937_64 bits(*rc::gen::arbitrary<unsigned>());
    const auto between = [&](double low, double high) {  // over decades
      return low * std::pow(high / low, std::uniform_real_distribution<double>()(bits));
    };
    const int balls = 1 + static_cast<int>(bits() % 8);
    std::string masses, drags;
    for (int i = 0; i < balls; ++i) {
      masses += fmt::format("{}\"{} g\"", i ? ", " : "", between(0.1, 1000.0));
      drags += fmt::format("{}\"{} N s/m\"", i ? ", " : "", between(1e-6, 10.0));
    }
    const double k = between(1e2, 1e8);
    const std::string text = fmt::format(
        "[rotor]\nmass=\"{} kg\"\nstiffness=[\"{} N/m\", \"{} N/m\"]\ndamping_ratio={}\nunbalance=\"{} g mm\"\n"
        "gravity=\"{} m/s2\"\n[balancer]\nballs={}\nrace_radius=\"{} mm\"\nmass=[{}]\ndrag=[{}]\n[speed]\n"
        "profile=\"ramp\"\ninitial=\"{} rpm\"\nfinal=\"{} Hz\"\nduration=\"{} ms\"\n[initial]\nx=\"{} um\"\n"
        "y_dot=\"{} mm/s\"\nphi=\"{} degree\"\n[limits]\ndisplacement=\"{} mm\"\nforce=\"{} kN\"\n",
        between(0.01, 1e4), k, k * between(0.5, 2.0), between(0.001, 1.0), between(1.0, 1e5), between(0.1, 10.0), balls,
        between(1.0, 1e3), masses, drags, between(1.0, 100.0), between(3.0, 1000.0), between(10.0, 1e5),
        between(0.1, 100.0), between(0.1, 100.0), between(1.0, 360.0), between(0.1, 10.0), between(0.01, 10.0));
    const Study a = parse(text);
    RC_ASSERT(first_difference(a, parse(to_physical_toml(a)), 1e-12) == "");
  }));
}

}  // namespace physical_study_test
}  // namespace equipoise
