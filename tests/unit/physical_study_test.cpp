// Studies in physical units: what each key becomes, what is refused and with which words, and the way back.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/study/physical.hpp"
#include "equipoise/study/physical_echo.hpp"
#include "equipoise/study/overrides.hpp"
#include "equipoise/study/study.hpp"
#include "study_difference.hpp"

namespace equipoise {
namespace {

// omega_c = sqrt(48000/12) = 63.2 rad/s = 604 rpm. Cases below count on these line numbers.
const std::string machine = R"([rotor]
mass = "12 kg"
stiffness = "48 kN/m"
damping = "200 N s/m"
eccentricity = "0.2 mm"
[balancer]
balls = 2
race_radius = "30 mm"
mass = "60 g"
drag = "1e-4 N m s"
[speed]
profile = "ramp"
final = "3000 rpm"
duration = "10 s"
)";
const double omega_c = std::sqrt(48000.0 / 12.0);

std::string with(const std::string& from, const std::string& to) {
  std::string text = machine;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Study parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_study(text, "m.toml", overrides);
}

// The dimensionless document, for keys that are not part of a Study here.
study::Document converted(const std::string& text, const std::vector<std::string>& overrides = {}) {
  study::Document document = study::parse_document(text, "m.toml", overrides);
  study::make_dimensionless(document);
  return document;
}

// A number by its dotted key, or an array's first entry.
double at(const study::Document& document, const std::string& path) {
  const StudyValue* value = &document.root;
  for (std::size_t begin = 0; value && begin <= path.size();) {
    const std::size_t dot = std::min(path.find('.', begin), path.size());
    value = value->find(path.substr(begin, dot - begin));
    begin = dot + 1;
  }
  if (value && value->array()) value = &value->array()->front();
  if (!value || !value->is_number()) throw std::logic_error(path + " is no number");
  return value->number();
}

TEST(PhysicalStudy, BecomesTheDimensionlessOneOfTheTextbook) {
  const Study s = parse(machine);
  ASSERT_TRUE(s.scales.has_value());
  EXPECT_DOUBLE_EQ(s.scales->mass, 12.0);
  EXPECT_DOUBLE_EQ(s.scales->length, 0.03);
  EXPECT_DOUBLE_EQ(s.scales->frequency, omega_c);
  EXPECT_DOUBLE_EQ(s.parameters.eccentricity, 0.2 / 30.0);
  EXPECT_DOUBLE_EQ(s.parameters.damping[0], 200.0 / std::sqrt(48000.0 * 12.0));
  EXPECT_EQ(s.parameters.damping[1], s.parameters.damping[0]);
  EXPECT_EQ(s.parameters.stiffness, (std::array<double, 2>{1.0, 1.0}));
  EXPECT_DOUBLE_EQ(s.parameters.mass[1], 0.06 / 12.0);
  EXPECT_DOUBLE_EQ(s.parameters.drag[1], 1e-4 / (0.06 * 0.03 * 0.03 * omega_c));
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
  same(base, parse(with("damping = \"200 N s/m\"",
                        fmt::format("damping_ratio = {}", 200.0 / (2.0 * std::sqrt(48000.0 * 12.0))))));
  same(base, parse(with("drag = \"1e-4 N m s\"", fmt::format("drag = \"{} N s/m\"", 1e-4 / (0.03 * 0.03)))));
  const double density = 0.06 / (pi / 6.0 * 1e-6);
  same(base,
       parse(with("mass = \"60 g\"", fmt::format("ball_diameter = \"10 mm\"\nball_density = \"{} kg/m3\"", density))));
}

TEST(PhysicalStudy, TakesTheMeanOfTwoStiffnessesForTheCriticalSpeed) {
  const Study s = parse(with("stiffness = \"48 kN/m\"\ndamping = \"200 N s/m\"",
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
  EXPECT_DOUBLE_EQ(parse(with("drag = \"1e-4 N m s\"\n", oil)).parameters.drag[0], beta);
  const std::string thin = "ball_diameter = \"8 mm\"\noil_viscosity = \"100 cSt\"\noil_density = \"1000 kg/m3\"\n";
  EXPECT_DOUBLE_EQ(parse(with("drag = \"1e-4 N m s\"\n", thin)).parameters.drag[0], beta);
  // A ball of half the channel's width: Haberman's exact factor is 5.970, the formula's error 2 %.
  const Study narrow = parse(with("drag = \"1e-4 N m s\"\n", oil + "channel_diameter = \"16 mm\"\n"));
  EXPECT_NEAR(narrow.parameters.drag[0], 5.970 * beta, 0.02 * 5.970 * beta);
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
  const auto d = converted(machine, {"rotor.inertia=0.0108 kg m2", "rotor.gravity=9.81 m/s2",
                                     "balancer.race_offset=['30 um', '0 um']", "balancer.ball_diameter=8 mm",
                                     "balancer.contact=true", "balancer.rolling=0.001", "speed.stalled_below=1500 rpm",
                                     "speed.torque={gain='0.1 N m s', integral='0.2 N m', limit='5 N m', "
                                     "target={profile='ramp', final='3000 rpm', duration='5 s'}}"});
  const double torque = 12.0 * 0.03 * 0.03 * omega_c * omega_c;
  EXPECT_DOUBLE_EQ(at(d, "rotor.inertia"), 1.0);
  EXPECT_DOUBLE_EQ(at(d, "rotor.gravity"), 9.81 / (0.03 * omega_c * omega_c));
  EXPECT_DOUBLE_EQ(at(d, "balancer.race_offset"), 0.001);
  EXPECT_DOUBLE_EQ(at(d, "balancer.contact_angle"), 2.0 * std::asin(4.0 / 30.0));
  EXPECT_EQ(at(d, "balancer.rolling"), 0.001);
  EXPECT_DOUBLE_EQ(at(d, "speed.stalled_below"), 50.0 * pi / omega_c);
  EXPECT_DOUBLE_EQ(at(d, "speed.torque.gain"), 0.1 * omega_c / torque);
  // A constant error of one critical speed raises the torque by 0.2 * omega_c each second.
  EXPECT_DOUBLE_EQ(at(d, "speed.torque.integral"), 0.2 * omega_c / torque / omega_c);
  EXPECT_DOUBLE_EQ(at(d, "speed.torque.limit"), 5.0 / torque);
  EXPECT_DOUBLE_EQ(at(d, "speed.torque.target.duration"), 5.0 * omega_c);
  EXPECT_FALSE(d.root.find("balancer")->find("ball_diameter"));
  EXPECT_FALSE(d.root.find("balancer")->find("contact"));
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

struct Bad {
  std::string text;
  std::vector<std::string> overrides;
  std::string where, key, value, problem;
};

void expect_rejected(const Bad& bad) {
  SCOPED_TRACE(bad.text == machine ? fmt::format("--set {}", bad.overrides.at(0)) : bad.text);
  try {
    parse(bad.text, bad.overrides);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), bad.where);
    EXPECT_EQ(error.key(), bad.key);
    EXPECT_EQ(error.value(), bad.value);
    EXPECT_EQ(error.problem(), bad.problem);
    for (const char c : std::string(error.what())) EXPECT_FALSE(std::iscntrl(static_cast<unsigned char>(c)));
  }
}

TEST(PhysicalStudy, RefusesPlainNumbersAndNamesTheKey) {
  expect_rejected({with("\"0.2 mm\"", "0.01"),
                   {},
                   "m.toml:5",
                   "rotor.eccentricity",
                   "0.01",
                   "is a plain number and rotor.mass makes this a study in physical units; must be a length of 0 or "
                   "more, such as \"0.2 mm\", or give rotor.unbalance, mass times eccentricity, such as \"300 g mm\""});
  expect_rejected({with("\"200 N s/m\"", "0.07"),
                   {},
                   "m.toml:4",
                   "rotor.damping",
                   "0.07",
                   "is a plain number and rotor.mass makes this a study in physical units; must be a damping coefficient "
                   "of 0 or more, such as \"200 N s/m\", or give rotor.damping_ratio, a plain number, c/(2 sqrt(k M))"});
  expect_rejected({with("\"10 s\"", "500"),
                   {},
                   "m.toml:14",
                   "speed.duration",
                   "500",
                   "is a plain number and rotor.mass makes this a study in physical units; must be a time greater than "
                   "0, such as \"10 s\""});
  expect_rejected({machine,
                   {"numerics.horizon=100.0"},
                   overrides_name,
                   "numerics.horizon",
                   "100.0",
                   "is a plain number and rotor.mass makes this a study in physical units; must be a time greater than "
                   "0, such as \"10 s\""});
  // And the other way round: a quantity where nothing else is physical.
  expect_rejected({"[rotor]\neccentricity = \"0.2 mm\"\n",
                   {},
                   "m.toml:2",
                   "rotor.eccentricity",
                   "\"0.2 mm\"",
                   "is a string; must be a finite number at least 0 (a study in physical units states rotor.mass)"});
}

TEST(PhysicalStudy, RefusesWrongDimensionsAndRanges) {
  expect_rejected({with("\"48 kN/m\"", "\"48 kN\""),
                   {},
                   "m.toml:3",
                   "rotor.stiffness",
                   "\"48 kN\"",
                   "\"kN\" does not measure that; must be a stiffness, such as \"48 kN/m\""});
  expect_rejected({with("\"12 kg\"", "\"-12 kg\""),
                   {},
                   "m.toml:2",
                   "rotor.mass",
                   "\"-12 kg\"",
                   "must be a mass greater than 0, such as \"12 kg\""});
  expect_rejected({with("\"12 kg\"", "\"1e40 kg\""),
                   {},
                   "m.toml:2",
                   "rotor.mass",
                   "\"1e40 kg\"",
                   "must be a mass greater than 0, such as \"12 kg\"; in SI units from 1e-30 to 1e+30 in size"});
  expect_rejected({with("\"60 g\"", "[\"60 g\", \"0 g\"]"),
                   {},
                   "m.toml:9",
                   "balancer.mass",
                   "[\"60 g\", \"0 g\"]",
                   "entry 2 must be a mass greater than 0, such as \"12 kg\""});
  expect_rejected({with("\"60 g\"", "[\"60 g\"]"),
                   {},
                   "m.toml:9",
                   "balancer.mass",
                   "[\"60 g\"]",
                   "has 1 entries; must be a mass greater than 0, such as \"12 kg\", or an array of 2, one a ball"});
  expect_rejected({machine,
                   {"speed.duration=-3 s"},
                   overrides_name,
                   "speed.duration",
                   "\"-3 s\"",
                   "must be a time greater than 0, such as \"10 s\""});
  expect_rejected({machine,
                   {"limits.force=0 N"},
                   overrides_name,
                   "limits.force",
                   "\"0 N\"",
                   "must be a force greater than 0, such as \"500 N\""});
  expect_rejected({machine,
                   {"numerics.horizon=1 ms"},
                   overrides_name,
                   "numerics.horizon",
                   "\"1 ms\"",
                   "must be a time from 0.0158114 s to 158114 s (1 to 10000000 times 1/omega_c)"});
}

TEST(PhysicalStudy, NamesMissingKeysAndTwoForOne) {
  expect_rejected({with("stiffness = \"48 kN/m\"\n", ""),
                   {},
                   "m.toml",
                   "rotor.stiffness",
                   "",
                   "missing; must be a stiffness greater than 0, such as \"48 kN/m\""});
  expect_rejected({with("mass = \"12 kg\"\n", ""),
                   {},
                   "m.toml",
                   "rotor.mass",
                   "",
                   "missing; must be a mass greater than 0, such as \"12 kg\", for balancer.race_radius makes this a "
                   "study in physical units"});
  expect_rejected({with("final = \"3000 rpm\"\n", ""),
                   {},
                   "m.toml",
                   "speed.final",
                   "",
                   "missing; must be a speed of rotation, such as \"3000 rpm\""});
  expect_rejected({with("duration = \"10 s\"\n", ""),
                   {},
                   "m.toml",
                   "speed.duration",
                   "",
                   "missing; must be a time greater than 0, such as \"10 s\""});
  expect_rejected({with("race_radius = \"30 mm\"\n", ""),
                   {},
                   "m.toml",
                   "balancer.race_radius",
                   "",
                   "missing; must be a length greater than 0, such as \"0.2 mm\""});
  expect_rejected({with("damping = \"200 N s/m\"\n", ""),
                   {},
                   "m.toml",
                   "rotor.damping",
                   "",
                   "missing; must be a damping coefficient of 0 or more, such as \"200 N s/m\", or give "
                   "rotor.damping_ratio, a plain number, c/(2 sqrt(k M))"});
  expect_rejected({machine,
                   {"rotor.damping_ratio=0.1"},
                   overrides_name,
                   "rotor.damping_ratio",
                   "0.1",
                   "give either rotor.damping or rotor.damping_ratio, not both"});
  expect_rejected({machine,
                   {"rotor.unbalance=3 g mm"},
                   overrides_name,
                   "rotor.unbalance",
                   "\"3 g mm\"",
                   "give either rotor.eccentricity or rotor.unbalance, not both"});
  expect_rejected({with("eccentricity = \"0.2 mm\"\n", ""),
                   {},
                   "m.toml",
                   "rotor.eccentricity",
                   "",
                   "missing; must be a length of 0 or more, such as \"0.2 mm\", or give rotor.unbalance, mass times "
                   "eccentricity, such as \"300 g mm\""});
  expect_rejected({machine,
                   {"balancer.oil_viscosity=1 Pa s"},
                   overrides_name,
                   "balancer.oil_viscosity",
                   "\"1 Pa s\"",
                   "give either balancer.drag or balancer.oil_viscosity, not both"});
  expect_rejected({machine,
                   {"balancer.oil_density=900 kg/m3"},
                   overrides_name,
                   "balancer.oil_density",
                   "\"900 kg/m3\"",
                   "has a meaning only with balancer.oil_viscosity"});
  expect_rejected({with("drag = \"1e-4 N m s\"", "oil_viscosity = \"1 Pa s\""),
                   {},
                   "m.toml:10",
                   "balancer.oil_viscosity",
                   "\"1 Pa s\"",
                   "needs balancer.ball_diameter, such as \"8 mm\""});
  expect_rejected({with("drag = \"1e-4 N m s\"", "ball_diameter = \"8 mm\"\noil_viscosity = \"90 cSt\""),
                   {},
                   "m.toml:11",
                   "balancer.oil_viscosity",
                   "\"90 cSt\"",
                   "is a kinematic viscosity and needs balancer.oil_density, such as \"900 kg/m3\""});
  expect_rejected({machine,
                   {"balancer.contact=true"},
                   overrides_name,
                   "balancer.contact",
                   "true",
                   "needs balancer.ball_diameter, such as \"8 mm\""});
  // Side by side 2 R sin(pi/6) each.
  expect_rejected({machine,
                   {"balancer.balls=6", "balancer.ball_diameter=30 mm", "balancer.contact=true"},
                   overrides_name,
                   "balancer.ball_diameter",
                   "\"30 mm\"",
                   "must be less than 30 mm: 6 balls that touch side by side fill the race then"});
  expect_rejected({machine,
                   {"balancer.rolls=true"},
                   overrides_name,
                   "balancer.rolls",
                   "true",
                   "needs balancer.ball_diameter, such as \"8 mm\""});
  expect_rejected({machine,
                   {"balancer.ball_radius=4 mm"},
                   overrides_name,
                   "balancer.ball_radius",
                   "\"4 mm\"",
                   "has a meaning only with balancer.rolls = true"});
  expect_rejected({machine,
                   {"balancer.ball_diameter=8 mm", "balancer.ball_radius=4 mm"},
                   overrides_name,
                   "balancer.ball_radius",
                   "\"4 mm\"",
                   "give either balancer.ball_radius or balancer.ball_diameter, not both"});
  expect_rejected({machine,
                   {"balancer.rolls=true", "balancer.ball_radius=30 mm"},
                   overrides_name,
                   "balancer.ball_radius",
                   "\"30 mm\"",
                   "must be less than balancer.race_radius"});
  expect_rejected({machine,
                   {"balancer.ball_diameter=60 mm"},
                   overrides_name,
                   "balancer.ball_diameter",
                   "\"60 mm\"",
                   "must be less than twice balancer.race_radius"});
  expect_rejected({machine + "[units]\nmass = 1.0\n",
                   {},
                   "m.toml:15",
                   "units",
                   "",
                   "belongs to a dimensionless study; here the units follow from rotor.mass, balancer.race_radius and "
                   "rotor.stiffness"});
}

TEST(PhysicalStudy, NamesUnknownKeysAmongThoseOfPhysicalStudies) {
  const std::string of_rotor =
      "(allowed: mass, stiffness, damping, damping_ratio, eccentricity, unbalance, gravity, inertia)";
  expect_rejected({with("eccentricity", "excentricity"),
                   {},
                   "m.toml:5",
                   "rotor.excentricity",
                   "\"0.2 mm\"",
                   "unknown key; did you mean \"eccentricity\"? " + of_rotor});
  expect_rejected({with("stiffness = \"48 kN/m\"", "natural_frequency = \"10 Hz\""),
                   {},
                   "m.toml:3",
                   "rotor.natural_frequency",
                   "\"10 Hz\"",
                   "unknown key; did you mean \"stiffness\"? " + of_rotor});
  expect_rejected({machine,
                   {"rotor.gravitiy=9.81 m/s2"},
                   overrides_name,
                   "rotor.gravitiy",
                   "\"9.81 m/s2\"",
                   "unknown key; did you mean \"gravity\"? (allowed: mass, stiffness, damping, damping_ratio, "
                   "eccentricity, unbalance, gravity, inertia)"});
}

TEST(PhysicalStudy, SpeaksOfRulesBetweenKeysInItsOwnUnits) {
  expect_rejected({machine,
                   {"release.speed=4000 rpm"},
                   overrides_name,
                   "release.speed",
                   "\"4000 rpm\"",
                   "the ramp function never reaches it; must be from 0 rpm to 3000 rpm"});
  const std::string trapezoid =
      "speed={profile='trapezoid', peak='50 Hz', final='40 Hz', rise_until='9 s', hold_until='8 s', fall_until='12 s'}";
  expect_rejected(
      {machine, {trapezoid}, overrides_name, "speed.hold_until", "\"8 s\"", "must be greater than rise_until, 9 s"});
  expect_rejected({machine,
                   {"release.time=10 s", "sampling.box.x=['0 mm', '1 mm']"},
                   overrides_name,
                   "sampling.box.x",
                   "[\"0 mm\", \"1 mm\"]",
                   "needs balls that are free from t = 0, but their release is at t = 10 s (clamped balls share one "
                   "spin-up); set release.time = 0 or leave [sampling.box] out"});
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
    // What a result carries is dimensionless, and would hold the balls if it said nothing.
    EXPECT_NE(to_toml(s).find("[release]\ntime = 0.0\n"), std::string::npos) << to_toml(s);
    EXPECT_EQ(parse(to_toml(s)).release_time(), 0.0) << speed;
    EXPECT_EQ(parse(to_physical_toml(s)).release_time(), 0.0) << speed;
  }
}

// Without units balls are held to the end of the ramp, and they still are once units are written.
TEST(PhysicalEcho, OfADimensionlessStudyStatesItsRelease) {
  const std::string units = "[units]\nmass = 12.0\nlength = 0.03\nfrequency = 63.2\n";
  const std::string rotor = "[rotor]\neccentricity = 0.01\ndamping = 0.5\n[balancer]\nballs = 2\nmass = 0.05\ndrag = 0.05\n";
  const Study held = parse(rotor + "[speed]\nprofile = \"ramp\"\nfinal = 2.4\nduration = 40.0\n" + units);
  EXPECT_EQ(held.release_time(), 40.0);
  EXPECT_NEAR(parse(to_physical_toml(held)).release_time(), 40.0, 1e-12);  // times a scale and over it
  const Study constant = parse(rotor + "[speed]\nprofile = \"constant\"\nspeed = 2.4\n" + units);
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

// Its result would else be told of balls that ran free.
TEST(PhysicalStudy, OfAnOlderResultHeldItsBalls) {
  std::string older = to_toml(parse(machine, {"rotor.eccentricity={uniform=['0.1 mm', '0.3 mm']}"}));
  const std::string release = "\n[release]\ntime = \"0 s\"\n";
  const std::string today = older;
  older.erase(older.find(release), release.size());
  EXPECT_DOUBLE_EQ(parse_kept_study(older, "older.nc").release_time(), 10.0 * omega_c);
  EXPECT_EQ(parse_kept_study(today, "today.nc").release_time(), 0.0);
}

TEST(Units, OfADimensionlessStudyAreKeptAndChecked) {
  const std::string text =
      "[rotor]\neccentricity=0.01\ndamping=0.5\n[balancer]\nballs=2\nmass=0.05\ndrag=0.05\n"
      "[speed]\nprofile=\"constant\"\nspeed=2.4\n[limits]\nforce=0.5\n[units]\nmass=12\nlength=0.03\n";
  const Study s = parse(text + "frequency=63.2\n");
  EXPECT_EQ(s.scales->frequency, 63.2);
  EXPECT_EQ(s.limits.force, 0.5);
  EXPECT_EQ(first_difference(s, parse(to_toml(s))), "");
  expect_rejected(
      {text, {}, "m.toml", "units.frequency", "", "missing; must be a number at least 1e-30 and at most 1e+30"});
  expect_rejected({text + "frequency=0\n",
                   {},
                   "m.toml:16",
                   "units.frequency",
                   "0",
                   "must be a number at least 1e-30 and at most 1e+30"});
  expect_rejected({text + "frequency=1\n",
                   {"limits.force=-1"},
                   overrides_name,
                   "limits.force",
                   "-1",
                   "must be a finite number greater than 0"});
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
  const auto close = [](double u, double v) { EXPECT_NEAR(u, v, 1e-12 * std::abs(u)); };  // a handful of roundings
  close(a.parameters.inertia, b.parameters.inertia);
  close(a.parameters.race_offset[0], b.parameters.race_offset[0]);
  close(a.parameters.race_offset[1], b.parameters.race_offset[1]);
  close(a.parameters.contact_angle, b.parameters.contact_angle);
  EXPECT_TRUE(b.parameters.rolls);
  close(a.parameters.ball_radius[1], b.parameters.ball_radius[1]);
  close(*a.speed.stalled_below, *b.speed.stalled_below);
  close(a.speed.initial, b.speed.initial);
  close(a.motor().gain, b.motor().gain);
  close(a.motor().integral, b.motor().integral);
  close(*a.motor().limit, *b.motor().limit);
  close(a.motor().target.final_speed(), b.motor().target.final_speed());
  close(a.motor().target.settled_time(), b.motor().target.settled_time());
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
    const std::string echo = to_physical_toml(a);
    const Study b = parse(echo);
    const auto close = [&](double u, double v) { RC_ASSERT(std::abs(u - v) <= 1e-12 * std::abs(u)); };
    close(a.scales->mass, b.scales->mass);
    close(a.scales->length, b.scales->length);
    close(a.scales->frequency, b.scales->frequency);
    close(a.parameters.eccentricity, b.parameters.eccentricity);
    close(a.parameters.gravity, b.parameters.gravity);
    for (std::size_t i = 0; i < 2; ++i) {
      close(a.parameters.damping[i], b.parameters.damping[i]);
      close(a.parameters.stiffness[i], b.parameters.stiffness[i]);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(balls); ++i) {
      close(a.parameters.mass[i], b.parameters.mass[i]);
      close(a.parameters.drag[i], b.parameters.drag[i]);
      close(a.initial.phi[i], b.initial.phi[i]);
    }
    close(a.speed.initial, b.speed.initial);
    close(a.speed.final, b.speed.final);
    close(a.speed.duration, b.speed.duration);
    close(a.initial.x, b.initial.x);
    close(a.initial.y_dot, b.initial.y_dot);
    close(*a.limits.displacement, *b.limits.displacement);
    close(*a.limits.force, *b.limits.force);
    close(a.numerics.horizon.value_or(0.0), b.numerics.horizon.value_or(0.0));
  }));
}

}  // namespace
}  // namespace equipoise
