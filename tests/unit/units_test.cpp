// Values with units: each text in SI units, and refusals.
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/balance/balance_grade.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise::study {
namespace units_test {

struct Reading {
  const char* text;
  Dimension dimension;
  double si;
};

// A factor and a product: one rounding each (EXPECT_DOUBLE_EQ allows four).
TEST(Units, AreWorthTheirSiValue) {
  for (const auto& [text, dimension, si] : std::vector<Reading>{
           {"12 kg", Dimension::mass, 12.0},
           {"5 g", Dimension::mass, 5e-3},
           {"48 kN/m", Dimension::stiffness, 48000.0},
           {"200 N s/m", Dimension::damping, 200.0},
           {"0.2 mm", Dimension::length, 0.2e-3},
           {"10 um", Dimension::length, 10e-6},
           {"10 micrometer", Dimension::length, 10e-6},
           {"300 g mm", Dimension::unbalance, 300e-6},
           {"9.81 m/s2", Dimension::acceleration, 9.81},
           {"9.81 m s-2", Dimension::acceleration, 9.81},
           {"0.02 kg m2", Dimension::inertia, 0.02},
           {"-0.01 N m s", Dimension::gain, -0.01},
           {"0.01 N m s/rad", Dimension::gain, 0.01},
           {"1 N m/rpm", Dimension::gain, 30.0 / pi},
           {"100 mPa s", Dimension::viscosity, 0.1},
           {"100 cSt", Dimension::kinematic_viscosity, 1e-4},
           {"7800 kg/m3", Dimension::density, 7800.0},
           {"2 min", Dimension::time, 120.0},
           {"30 ms", Dimension::time, 0.03},
           {"1 kg/(m s)", Dimension::viscosity, 1.0},
           {"1 kg m^-1 s^-1", Dimension::viscosity, 1.0},
           {"1 N.m-1", Dimension::stiffness, 1.0},
           {"2 N*m", Dimension::torque, 2.0},
           {"2 N-m", Dimension::torque, 2.0},
           {"30 degree", Dimension::angle, pi / 6.0},
           {"+1.5e3 rpm", Dimension::speed, 50.0 * pi},
           {"3000 rpm", Dimension::speed, 100.0 * pi},
           {"314 rad/s", Dimension::speed, 314.0},
           {"90 degree/s", Dimension::speed, pi / 2.0},
           {"50 revolution/s", Dimension::speed, 100.0 * pi},
           {"3000 1/min", Dimension::speed, 100.0 * pi},
           {"3000 min-1", Dimension::speed, 100.0 * pi},
           {"3000 min^-1", Dimension::speed, 100.0 * pi},
           {"3000 min\u207B\u00B9", Dimension::speed, 100.0 * pi},
           {"3000 rev/min", Dimension::speed, 100.0 * pi},
           {"3000 r/min", Dimension::speed, 100.0 * pi},
           {"3/4 in", Dimension::length, 0.75 * 0.0254},
           {"1 1/2 in", Dimension::length, 1.5 * 0.0254},
           {"-1 1/2 in", Dimension::length, -1.5 * 0.0254},
           {"2 lbf", Dimension::force, 2.0 * 0.45359237 * 9.80665},
           {"2 kgf", Dimension::force, 2.0 * 9.80665},
           {"2 kp", Dimension::force, 2.0 * 9.80665},
           {"10 lbf/in", Dimension::stiffness, 10.0 * 0.45359237 * 9.80665 / 0.0254},
           {"2 oz in", Dimension::unbalance, 2.0 * 0.45359237 / 16.0 * 0.0254},
           {"2 ozf in", Dimension::torque, 2.0 * 0.45359237 / 16.0 * 9.80665 * 0.0254},
           {"2 g in", Dimension::unbalance, 2e-3 * 0.0254},
           {"3 lbs", Dimension::mass, 3.0 * 0.45359237},
           {"1 oz", Dimension::mass, 0.45359237 / 16.0},
           {"100 cP", Dimension::viscosity, 0.1},
           {"0.3 kgf m2", Dimension::weight_inertia, 0.3 * 9.80665},
           {"40 degC", Dimension::temperature, 313.15},
           {"40 \u00B0C", Dimension::temperature, 313.15},
           {"104 degF", Dimension::temperature, 313.15},
           {"313.15 K", Dimension::temperature, 313.15},
       }) {
    const Measured read = measure(text, {dimension});
    EXPECT_EQ(read.problem, "") << text;
    EXPECT_DOUBLE_EQ(read.value, si) << text;
  }
}

// As people and keyboards write them: the micro sign and the Greek letter, superscript digits, dots, unit signs.
TEST(Units, BeyondAsciiAreWorthTheSame) {
  for (const auto& [text, dimension, si] : std::vector<Reading>{
           {"20 \u00B5m", Dimension::length, 20e-6},
           {"20 \u03BCm", Dimension::length, 20e-6},
           {"20\u00A0\u00B5m", Dimension::length, 20e-6},
           {"20\u00B5m", Dimension::length, 20e-6},
           {"500 \u00B5s", Dimension::time, 500e-6},
           {"30\u00B0", Dimension::angle, pi / 6.0},
           {"90 \u00B0/s", Dimension::speed, pi / 2.0},
           {"30\u2032", Dimension::angle, pi / 360.0},
           {"9.81 m/s\u00B2", Dimension::acceleration, 9.81},
           {"9.81 m\u00B7s\u207B\u00B2", Dimension::acceleration, 9.81},
           {"7800 kg/m\u00B3", Dimension::density, 7800.0},
           {"0.02 kg\u00B7m\u00B2", Dimension::inertia, 0.02},
           {"0.5 N\u22C5m", Dimension::torque, 0.5},
           {"2 N\u202Fs/m", Dimension::damping, 2.0},
           {"100 mPa\u00B7s", Dimension::viscosity, 0.1},
       }) {
    const Measured read = measure(text, {dimension});
    EXPECT_EQ(read.problem, "") << text;
    EXPECT_DOUBLE_EQ(read.value, si) << text;
  }
  EXPECT_EQ(measure("3 \u03A9", {Dimension::length}).problem,
            "\"\u03A9\" is not a known unit; must be a length, such as \"0.2 mm\"");
  EXPECT_EQ(measure("3 \u00B5", {Dimension::length}).problem,
            "\"\u00B5\" is not a known unit; must be a length, such as \"0.2 mm\"");
  for (const char* text : {"3 \u00B2", "3 m\u00B2\u00B2", "3 m\u207B", "3 m\xB2", "3 \xB5m", "3 10\u00B2 m",
                           "3 \u00D7 m", "3 \u0085", "3 \u00B7", "3 \u00B0C"})
    EXPECT_NE(measure(text, {Dimension::length}).problem, "") << text;
}

TEST(Units, BeyondAsciiAreReadInStudies) {
  const auto study = [](const std::string& eccentricity, const std::vector<std::string>& overrides = {}) {
    return parse_study(
               "[rotor]\nmass = \"12 kg\"\nstiffness = \"48 kN/m\"\ndamping = '200 N\u00B7s/m'\neccentricity = " +
                   eccentricity +
                   "\n[balancer]\nballs = 2\nrace_radius = \"30 mm\"\nmass = \"60 g\"\ndrag = \"1e-4 N m s\"\n"
                   "race_offset = [\"1 \u00B5m\", \"2 \u00B5m\"]\n[speed]\nprofile = \"constant\"\nspeed = \"3000 "
                   "rpm\"\n",
               "m.toml", overrides)
        .parameters;
  };
  EXPECT_DOUBLE_EQ(study("\"20 \u00B5m\"").eccentricity, 20e-6 / 30e-3);
  EXPECT_DOUBLE_EQ(study("\"20 \u00B5m\"").race_offset[1], 2e-6 / 30e-3);
  EXPECT_DOUBLE_EQ(study("\"1 mm\"", {"rotor.eccentricity=20 \u03BCm"}).eccentricity, 20e-6 / 30e-3);
  EXPECT_DOUBLE_EQ(study("\"1 mm\"", {"balancer.race_offset=['3 \u03BCm', '0 um']"}).race_offset[0], 3e-6 / 30e-3);
}

TEST(Units, PartsOfAHundred) {
  EXPECT_DOUBLE_EQ(*percentage("5 %"), 0.05);
  EXPECT_DOUBLE_EQ(*percentage("12.5%"), 0.125);
  for (const char* text : {"5", "%", "5 % %", "5 percent", "", "x %"}) EXPECT_FALSE(percentage(text)) << text;
}

TEST(Units, FractionsNeedAllTheirParts) {
  for (const char* text : {"3/ in", "/4 in", "1/0 in", "1.5/2 in", "1 1/2", "1 1/2in", "3/4/5 in"})
    EXPECT_NE(measure(text, {Dimension::length}).problem, "") << text;
}

TEST(Units, HertzOfARotorAreTurnsASecond) {
  EXPECT_DOUBLE_EQ(measure("50 Hz", {Dimension::speed}).value, 100.0 * pi);
  EXPECT_DOUBLE_EQ(measure("0.05 kHz", {Dimension::speed}).value, 100.0 * pi);
  EXPECT_NE(measure("50 1/s", {Dimension::speed}).problem, "");  // turns or radians?
  EXPECT_NE(measure("2 1/min", {Dimension::gain}).problem, "");
  EXPECT_NE(measure("50 s-1", {Dimension::speed}).problem, "");
  EXPECT_NE(measure("1 N m/Hz", {Dimension::gain}).problem, "");
}

TEST(Units, OneTextMayMeasureEitherOfTwo) {
  const std::vector<Dimension> either{Dimension::gain, Dimension::damping};
  EXPECT_EQ(measure("1 N m s", either).dimension, Dimension::gain);
  EXPECT_EQ(measure("1 N s/m", either).dimension, Dimension::damping);
  EXPECT_EQ(
      measure("1 kg", either).problem,
      "\"kg\" is a unit of something else; must be a torque for a speed of rotation, such as \"0.01 N m s\", or a "
      "damping coefficient, such as \"200 N s/m\"");
}

TEST(Units, SayWhatIsWrong) {
  const auto problem = [](const char* text) { return measure(text, {Dimension::mass}).problem; };
  EXPECT_EQ(problem("12"), "has no unit; must be a mass, such as \"12 kg\"");
  EXPECT_EQ(problem("kg"), "does not begin with a number; must be a mass, such as \"12 kg\"");
  EXPECT_EQ(problem(""), "does not begin with a number; must be a mass, such as \"12 kg\"");
  EXPECT_EQ(problem("12 mm"), "\"mm\" is a unit of something else; must be a mass, such as \"12 kg\"");
  EXPECT_EQ(problem("12 stones"), "\"stones\" is not a known unit; must be a mass, such as \"12 kg\"");
  EXPECT_EQ(problem("12 KG"), "\"KG\" is not a known unit (did you mean \"kg\"?); must be a mass, such as \"12 kg\"");
  EXPECT_EQ(problem("12 degC"), "\"degC\" is a unit of something else; must be a mass, such as \"12 kg\"");
  EXPECT_EQ(measure("3 rpn", {Dimension::speed}).problem,
            "\"rpn\" is not a known unit (did you mean \"rpm\"?); must be a speed of rotation, such as \"3000 rpm\"");
  EXPECT_EQ(problem("12 kg\n"), "is not a number with a unit; must be a mass, such as \"12 kg\"");
  EXPECT_EQ(problem("1e999 kg"), "the number is out of range; must be a mass, such as \"12 kg\"");
  EXPECT_EQ(problem("nan kg"), "the number is out of range; must be a mass, such as \"12 kg\"");
  EXPECT_EQ(
      measure("3 s", {Dimension::speed}).problem,
      "\"s\" is a unit of something else; must be a speed of rotation, such as \"3000 rpm\"; in rpm, 1/min, rad/s or "
      "Hz (turns "
      "per second)");
}

// What is meant has the dimension that is wanted.
TEST(Units, HintAtUnitsOfTheSameDimension) {
  const auto problem = [](const char* text, Dimension d) { return measure(text, {d}).problem; };
  EXPECT_NE(problem("30 dgree", Dimension::angle).find("did you mean \"degree\"?"), std::string::npos);
  EXPECT_NE(problem("40 dgC", Dimension::temperature).find("did you mean \"degC\"?"), std::string::npos);
  EXPECT_EQ(problem("22 lbg", Dimension::mass).find("lbf"), std::string::npos);
  EXPECT_NE(problem("22 lbg", Dimension::force).find("did you mean \"lbf\"?"), std::string::npos);
  EXPECT_EQ(problem("300 mmg", Dimension::unbalance).find("did you mean"), std::string::npos);
  EXPECT_NEAR(measure("40 C", {Dimension::temperature}).value, 313.15, 1e-12);
  EXPECT_NEAR(measure("104 F", {Dimension::temperature}).value, 313.15, 1e-12);
  EXPECT_NE(problem("40 C", Dimension::mass), "");
}

// None is in proportion: a reciprocal, an offset, a logarithm, a pure number.
TEST(Units, RefuseWhatIsNotInProportion) {
  EXPECT_NE(measure("3 Hz", {Dimension::time}).problem, "");
  EXPECT_NE(measure("3 m @ 4", {Dimension::length}).problem, "");
  EXPECT_NE(measure("3 lg(re 1 kg)", {Dimension::mass}).problem, "");
  EXPECT_NE(measure("3 1", {Dimension::angle}).problem, "");
  EXPECT_NE(measure("3 rad2/s", {Dimension::speed}).problem, "");
  for (const char* text :
       {"3 m m-", "3 m/", "3 /m", "3 (m", "3 m)", "3 ((m))", "3 m^", "3 m22", "3 m per", "3 m 1e9", "3 m%"})
    EXPECT_NE(measure(text, {Dimension::length}).problem, "") << text;
}

TEST(Units, AreShownSoThatTheyReadBack) {
  for (int i = 0; i <= static_cast<int>(Dimension::angle); ++i) {
    const auto dimension = static_cast<Dimension>(i);
    const Measured read = measure(quantity_text(0.123456789, dimension), {dimension});
    EXPECT_EQ(read.problem, "") << words(dimension).name;
    EXPECT_DOUBLE_EQ(read.value, 0.123456789) << words(dimension).name;
    EXPECT_EQ(measure(words(dimension).example, {dimension}).problem, "");
  }
}

TEST(Units, AreReadBySeveralThreads) {
  std::atomic<int> good{0};
  {
    std::vector<std::jthread> workers;
    for (int thread = 0; thread < 4; ++thread)
      workers.emplace_back([&] {
        for (int k = 0; k < 300; ++k)
          good += measure("3000 rpm", {Dimension::speed}).problem.empty() &&
                  !measure("3 stones", {Dimension::mass}).problem.empty();
      });
  }
  EXPECT_EQ(good, 4 * 300);
}

TEST(BalanceGrade, IsEccentricityTimesSpeed) {
  // 50 um at 3000 rpm: 50e-6 m * 314.16 rad/s = 15.7 mm/s, within G 16.
  EXPECT_NEAR(model::balance_grade(50e-6, 100.0 * pi), 15.708, 1e-3);
  EXPECT_DOUBLE_EQ(model::balance_grade(1e-3, -2.0), 2.0);
  EXPECT_EQ(model::standard_grade_met(15.7), 16.0);
  EXPECT_EQ(model::standard_grade_met(16.0), 16.0);
  EXPECT_EQ(model::standard_grade_met(0.0), 0.4);
  EXPECT_FALSE(model::standard_grade_met(4001.0).has_value());
  // The same quantity in other units differs by roundings.
  EXPECT_EQ(model::standard_grade_met(6.3 * (1.0 + 1e-14)), 6.3);
  EXPECT_EQ(model::standard_grade_met(6.3 * (1.0 + 1e-6)), 16.0);
}

}  // namespace units_test
}  // namespace equipoise::study
