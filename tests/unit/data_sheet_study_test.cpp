// Studies as an engineer's data sheet states them: every way to say a quantity is the same machine, and two at once are
// refused.
#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/datasheet/oils.hpp"
#include "equipoise/machine/datasheet/vibration_data.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/echo/physical_echo.hpp"
#include "../support/studies.hpp"
#include "../support/study_difference.hpp"

namespace equipoise {
namespace data_sheet_study_test {

using Overrides = std::vector<std::string>;

const std::string& sheet = ramp_machine;
const double sheet_omega = std::sqrt(48000.0 / 12.0);

std::string sheet_with(const std::string& from, const std::string& to) { return with(sheet, from, to); }

Study parse_sheet(const std::string& text, const Overrides& overrides = {}) {
  return parse_study(text, "m.toml", overrides);
}

std::string refusal_of(const std::string& text, const Overrides& overrides = {}) {
  try {
    parse_sheet(text, overrides);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

// A handful of roundings apart.
void expect_same(const Study& a, const Study& b) {
  EXPECT_NEAR(a.scales->frequency / b.scales->frequency, 1.0, 1e-14);
  EXPECT_NEAR(a.parameters.eccentricity, b.parameters.eccentricity, 1e-15);
  EXPECT_NEAR(a.parameters.inertia, b.parameters.inertia, 1e-14);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(a.parameters.damping[i], b.parameters.damping[i], 1e-14);
    EXPECT_NEAR(a.parameters.stiffness[i], b.parameters.stiffness[i], 1e-14);
    EXPECT_NEAR(a.parameters.mass[i], b.parameters.mass[i], 1e-14);
  }
}

TEST(DataSheet, StatesSupportsInSeveralWays) {
  const Study base = parse_sheet(sheet);
  const std::string stiffness = "stiffness = \"48 kN/m\"";
  expect_same(base,
              parse_sheet(sheet_with(stiffness, fmt::format("natural_frequency = \"{} Hz\"", sheet_omega / two_pi))));
  expect_same(base, parse_sheet(sheet_with(
                        stiffness, fmt::format("natural_frequency = \"{} rpm\"", 60.0 * sheet_omega / two_pi))));
  const auto sag = [](double g) { return fmt::format("static_sag = \"{} mm\"", 1000.0 * 12.0 * g / 48000.0); };
  expect_same(base, parse_sheet(sheet_with(stiffness, sag(9.80665))));
  // With gravity stated, it is that gravity.
  expect_same(parse_sheet(sheet, {"rotor.gravity=1.62 m/s2"}),
              parse_sheet(sheet_with(stiffness, sag(1.62)), {"rotor.gravity=1.62 m/s2"}));
  EXPECT_EQ(parse_sheet(sheet_with(stiffness, sag(1.62)), {"rotor.gravity=1.62 m/s2"}).parameters.gravity,
            parse_sheet(sheet, {"rotor.gravity=1.62 m/s2"}).parameters.gravity);
  expect_same(parse_sheet(sheet_with(stiffness, "stiffness = [\"12 kN/m\", \"48 kN/m\"]")),
              parse_sheet(sheet_with(stiffness, fmt::format("natural_frequency = [\"{} rad/s\", \"{} rad/s\"]",
                                                            sheet_omega / 2.0, sheet_omega))));
}

TEST(DataSheet, StatesDampingInSeveralWays) {
  const std::string damping = "damping = \"400 N s/m\"";
  const auto same = [&](const std::string& rotor, const std::array<double, 2>& zeta) {
    const auto ways = [&](auto&& of) { return fmt::format("[{}, {}]", of(zeta[0]), of(zeta[1])); };
    const Study base = parse_sheet(sheet_with(damping, "damping_ratio = " + ways([](double z) { return z; })), {rotor});
    const auto decrement = [](double z) { return two_pi * z / std::sqrt(1.0 - z * z); };
    expect_same(base, parse_sheet(sheet_with(damping, "logarithmic_decrement = " + ways(decrement)), {rotor}));
    expect_same(
        base, parse_sheet(sheet_with(damping, "quality_factor = " + ways([](double z) { return 0.5 / z; })), {rotor}));
    expect_same(base,
                parse_sheet(sheet_with(damping, "loss_factor = " + ways([](double z) { return 2.0 * z; })), {rotor}));
    expect_same(base, parse_sheet(sheet_with(damping, "damping_ratio = " + ways([](double z) {
                                                        return fmt::format("\"{} %\"", 100.0 * z);
                                                      })),
                                  {rotor}));
  };
  same("rotor.stiffness=48 kN/m", {0.1, 0.1});
  same("rotor.stiffness=['40 kN/m', '56 kN/m']", {0.05, 0.2});
  // zeta of the equations is twice the usual ratio.
  EXPECT_NEAR(parse_sheet(sheet_with(damping, "quality_factor = 8")).parameters.damping[0], 1.0 / 8.0, 1e-15);
}

TEST(DataSheet, StatesTheRaceByRadiusOrDiameter) {
  const std::string radius = "race_radius = \"30 mm\"", diameter = "race_diameter = \"6 cm\"";
  EXPECT_EQ(parse_sheet(sheet_with(radius, diameter)).scales->length, 0.5 * 0.06);
  expect_same(parse_sheet(sheet), parse_sheet(sheet_with(radius, diameter)));
  expect_same(parse_sheet(sheet, {"balancer.balls=0"}),
              parse_sheet(sheet_with(radius, diameter), {"balancer.balls=0"}));
  const std::string both = refusal_of(sheet_with(radius, radius + "\n" + diameter));
  EXPECT_NE(both.find("give either balancer.race_radius or balancer.race_diameter"), std::string::npos) << both;
}

TEST(DataSheet, StatesUnbalanceAndInertiaInSeveralWays) {
  const std::string eccentricity = "eccentricity = \"0.2 mm\"";
  const double speed = 100.0 * pi;
  const double g63 = 6.3e-3 / speed / 0.03;
  for (const char* grade : {"G 6.3", "G6.3", "6.3 mm/s"})
    EXPECT_NEAR(parse_sheet(sheet_with(eccentricity,
                                       fmt::format("balance_grade = {{ grade = \"{}\", at = \"3000 rpm\" }}", grade)))
                    .parameters.eccentricity,
                g63, 1e-15)
        << grade;
  const Study base = parse_sheet(sheet, {"rotor.inertia=0.0432 kg m2"});
  expect_same(base, parse_sheet(sheet, {"rotor.radius_of_gyration=60 mm"}));
  expect_same(base, parse_sheet(sheet, {"rotor.gd2=0.1728 kgf m2"}));
  expect_same(base, parse_sheet(sheet, {"rotor.gd2=0.1728 kg m2"}));
}

TEST(DataSheet, RefusesTwoWaysAtOnceAndNamesBoth) {
  for (const auto& [first, second, value] : std::vector<std::array<std::string, 3>>{
           {"stiffness", "natural_frequency", "8 Hz"},
           {"stiffness", "static_sag", "3 mm"},
           {"damping", "damping_ratio", "0.1"},
           {"damping", "logarithmic_decrement", "0.3"},
           {"damping", "quality_factor", "8"},
           {"damping", "loss_factor", "0.1"},
           {"eccentricity", "unbalance", "3 g mm"},
           {"eccentricity", "balance_grade", "{ grade = 'G 6.3', at = '3000 rpm' }"}}) {
    const std::string said = refusal_of(sheet, {"rotor." + second + "=" + value});
    EXPECT_TRUE(holds(said, fmt::format("give either rotor.{} or rotor.{}, not both", first, second))) << said;
  }
  EXPECT_TRUE(holds(refusal_of(sheet, {"rotor.gd2=1 kg m2", "rotor.inertia=1 kg m2"}),
                    "give either rotor.inertia or rotor.gd2, not both"));
  const std::string missing = refusal_of(sheet_with("damping = \"400 N s/m\"\n", ""));
  for (const char* key : {"rotor.damping: missing", "200 N s/m", "rotor.damping_ratio", "rotor.logarithmic_decrement",
                          "rotor.quality_factor"})
    EXPECT_TRUE(holds(missing, key)) << missing;
}

TEST(DataSheet, RefusesGradesThatAreNone) {
  for (const char* grade : {"'H 6.3'", "'G'", "'G x'", "6.3", "'-6.3 mm/s'", "'G 0'", "'6.3 mm'"}) {
    const std::string said = refusal_of(sheet_with("eccentricity = \"0.2 mm\"\n", ""),
                                        {fmt::format("rotor.balance_grade={{ grade = {}, at = '50 Hz' }}", grade)});
    EXPECT_TRUE(holds(said, "rotor.balance_grade.grade") && holds(said, "such as \"G 6.3\"")) << said;
  }
  EXPECT_TRUE(
      holds(refusal_of(sheet_with("eccentricity = \"0.2 mm\"\n", ""), {"rotor.balance_grade={ grade = 'G 6.3' }"}),
            "rotor.balance_grade.at: missing"));
}

// The whole study is written again for each draw, so that a drawn grade or frequency reaches all that follows from it.
TEST(DataSheet, MayBeUncertain) {
  struct Case {
    std::string from, key, distribution;
    std::string drawn;
    double value;
  };
  const std::string stiffness = "stiffness = \"48 kN/m\"\n", damping = "damping = \"400 N s/m\"\n",
                    race = "race_radius = \"30 mm\"\n", eccentricity = "eccentricity = \"0.2 mm\"\n";
  for (const Case& c : std::vector<Case>{
           {stiffness, "rotor.natural_frequency", "{uniform=['8 Hz', '12 Hz']}", "rotor.natural_frequency=9 Hz", 9.0},
           {stiffness, "rotor.static_sag", "{values=['2 mm', '3 mm']}", "rotor.static_sag=3 mm", 3.0},
           {damping, "rotor.quality_factor", "{normal=[8.0, 1.0], between=[5.0, 12.0]}", "rotor.quality_factor=9", 9.0},
           {damping, "rotor.damping_ratio", "{uniform=['3 %', '7 %']}", "rotor.damping_ratio=0.06", 6.0},
           {damping, "rotor.loss_factor", "{uniform=[0.1, 0.2]}", "rotor.loss_factor=0.15", 0.15},
           {race, "balancer.race_diameter", "{uniform=['5 cm', '7 cm']}", "balancer.race_diameter=6.5 cm", 6.5},
           {eccentricity, "rotor.balance_grade", "{grade={uniform=['2.5 mm/s', '6.3 mm/s']}, at='3000 rpm'}",
            "rotor.balance_grade={grade='G 4', at='3000 rpm'}", 4.0},
           {"", "rotor.gd2", "{loguniform=['0.1 kgf m2', '0.4 kgf m2']}", "rotor.gd2=0.2 kgf m2", 0.2}}) {
    const std::string text = c.from.empty() ? sheet : sheet_with(c.from, "");
    const Study uncertain = parse_sheet(text, {c.key + "=" + c.distribution});
    ASSERT_EQ(uncertain.uncertain.values.size(), 1u) << c.key;
    expect_same(drawn_study(uncertain, std::vector{c.value}), parse_sheet(text, {c.drawn}));
    Study without_text = uncertain;
    without_text.uncertain.physical.reset();
    expect_same(drawn_study(without_text, std::vector{c.value}), parse_sheet(text, {c.drawn}));
    EXPECT_NO_THROW(check(uncertain)) << c.key;
    // As a result keeps it.
    EXPECT_EQ(first_difference(uncertain, parse_sheet(to_toml(uncertain))), "") << to_toml(uncertain);
  }
}

TEST(DataSheet, LeadsToADimensionlessStudyThatReadsBack) {
  const Study s = parse_sheet(sheet_with("stiffness = \"48 kN/m\"\ndamping = \"400 N s/m\"",
                                         "natural_frequency = \"8 Hz\"\nquality_factor = 8"),
                              {"rotor.gd2=0.2 kgf m2"});
  EXPECT_EQ(first_difference(s, parse_sheet(to_toml(s))), "");
  EXPECT_EQ(first_difference(s, parse_sheet(to_physical_toml(s)), 1e-12), "");
}

TEST(DataSheet, AsksForTheInertiaOfADrivenRotorInItsWays) {
  const Overrides motor{"speed={profile='torque', torque={stall='2 N m', no_load_speed='3000 rpm'}}"};
  const std::string said = refusal_of(sheet, motor);
  EXPECT_TRUE(holds(said,
                    "rotor.inertia: must be a moment of inertia greater than 0, such as \"0.02 kg m2\", for a driven "
                    "rotor (profile \"torque\"), or give rotor.radius_of_gyration or rotor.gd2"))
      << said;
  Overrides with_gd2 = motor;
  with_gd2.push_back("rotor.gd2=0.2 kgf m2");
  EXPECT_NEAR(parse_sheet(sheet, with_gd2).parameters.inertia, 0.05 / (12.0 * 0.03 * 0.03), 1e-13);
}

// A result carries the study as written, whatever its keys hold.
TEST(DataSheet, KeepsKeysInQuotes) {
  const Study s = parse_sheet(sheet + "[design.vary]\n\"balancer.drag\" = [\"1e-4 N m s\", \"1e-3 N m s\"]\n",
                              {"rotor.eccentricity={uniform=['0.1 mm', '0.2 mm']}"});
  EXPECT_TRUE(holds(to_toml(s), "\"balancer.drag\" = [")) << to_toml(s);
  EXPECT_EQ(to_toml(parse_sheet(to_toml(s))), to_toml(s));
}

TEST(DataSheet, RefusesAGravityThatNoNumberFollows) {
  EXPECT_TRUE(
      holds(refusal_of(constant_speed, {"rotor.gravity=1e300"}), "rotor.gravity = 1e+300: pulls the rotor further"));
  EXPECT_EQ(refusal_of(constant_speed, {"rotor.gravity=1e290"}), "");
}

// Balls and oil.

const std::string oiled = sheet_with("mass = \"60 g\"\ndrag = \"2e-4 N m s\"\n", "ball_diameter = \"8 mm\"\n");

TEST(DataSheet, KnowsMaterialsOfBalls) {
  const std::string viscosity = "balancer.oil_viscosity=100 mPa s";
  const double volume = pi / 6.0 * 8e-3 * 8e-3 * 8e-3;
  EXPECT_NEAR(parse_sheet(oiled, {viscosity, "balancer.ball_material=steel"}).parameters.mass[0],
              7810.0 * volume / 12.0, 1e-16);
  EXPECT_GT(parse_sheet(oiled, {viscosity, "balancer.ball_material=tungsten carbide"}).parameters.mass[0],
            1.8 * 7810.0 * volume / 12.0);
  const std::string said = refusal_of(oiled, {viscosity, "balancer.ball_material=stel"});
  EXPECT_TRUE(
      holds(said,
            "is not a material in the table (balancer.ball_density states any density); did you mean \"steel\"? must "
            "be one of: steel, stainless steel, tungsten carbide, ceramic, glass"))
      << said;
  EXPECT_TRUE(holds(refusal_of(oiled, {viscosity, "balancer.ball_material=steel", "balancer.mass=3 g"}),
                    "give either balancer.mass or balancer.ball_material, not both"));
  EXPECT_TRUE(
      holds(refusal_of(sheet_with("mass = \"60 g\"", "ball_material = \"steel\"")), "needs balancer.ball_diameter"));
}

TEST(DataSheet, KnowsOilsByTheirGrade) {
  const std::string steel = "balancer.ball_material=steel";
  const auto details = [&](const Overrides& overrides) {
    Overrides all = overrides;
    all.push_back(steel);
    const DataSheet d = parse_sheet(oiled, all).sheet;
    EXPECT_TRUE(d.oil_viscosity && d.oil_density);
    return d;
  };
  const DataSheet vg32 = details({"balancer.oil={ grade = 'ISO VG 32', at = '40 degC' }"});
  EXPECT_NEAR(*vg32.oil_viscosity, 32e-6 * 870.0, 1e-12);
  EXPECT_EQ(*vg32.oil_density, 870.0);
  EXPECT_NEAR(*details({"balancer.oil={ grade = 'ISO VG 32', at = '104 degF' }"}).oil_viscosity, 32e-6 * 870.0, 1e-9);
  EXPECT_NEAR(*details({"balancer.oil={ grade = 'ISO VG 32', at = '20 degC' }", "balancer.oil_density=900 kg/m3"})
                   .oil_viscosity,
              88e-6 * 900.0, 0.005 * 88e-6 * 900.0);
  EXPECT_NEAR(
      *details({"balancer.oil={ grade = 'ISO VG 5', at = '100 degC', viscosity_100 = '1.6 cSt' }"}).oil_viscosity,
      1.6e-6 * 870.0, 1e-12);
  EXPECT_NEAR(*details({"balancer.oil={ grade = 'silicone 1000 cSt', at = '25 degC' }"}).oil_viscosity, 0.97, 1e-9);
  for (const char* name : {"VG 32", "vg32", "ISO VG32", "iso vg 32"})
    EXPECT_EQ(*details({fmt::format("balancer.oil={{ grade = '{}', at = '40 degC' }}", name)}).oil_viscosity,
              *vg32.oil_viscosity)
        << name;
  EXPECT_EQ(*details({"balancer.oil={ grade = 'Silicone 100 mm2/s', at = '25 degC' }"}).oil_density, 970.0);
  // The same drag as of the viscosity itself.
  const double beta =
      parse_sheet(oiled, {steel, "balancer.oil={ grade = 'ISO VG 32', at = '40 degC' }"}).parameters.drag[0];
  EXPECT_NEAR(
      beta,
      parse_sheet(oiled, {steel, "balancer.oil_viscosity=32 cSt", "balancer.oil_density=870 kg/m3"}).parameters.drag[0],
      1e-12 * beta);
  // A temperature that is not known.
  const Study warm =
      parse_sheet(oiled, {steel, "balancer.oil={ grade = 'ISO VG 32', at = {uniform=['20 degC', '60 degC']} }"});
  ASSERT_EQ(warm.uncertain.values.size(), 1u);
  EXPECT_EQ(warm.uncertain.values[0].key, "balancer.oil.at");
  EXPECT_NEAR(warm.parameters.drag[0], beta, 1e-12 * beta);
  EXPECT_GT(drawn_study(warm, std::vector{20.0}).parameters.drag[0], 2.0 * beta);
}

// 12 is typed for 12 %, and would be 1200 %.
TEST(DataSheet, RefusesDampingRatiosThatAreMeantAsPercentages) {
  const auto said = [](const std::string& ratio) {
    return refusal_of(with(constant_machine, "damping = \"400 N s/m\"", "damping_ratio = " + ratio), {});
  };
  EXPECT_TRUE(holds(said("12"), "damping_ratio = 12: must be at most 1, or a percentage; did you mean \"12 %\"?"))
      << said("12");
  EXPECT_TRUE(holds(said("[0.1, 1.5]"), "did you mean \"1.5 %\"?")) << said("[0.1, 1.5]");
  for (const char* ratio : {"0.12", "1", "\"120 %\"", "\"12 %\""})
    EXPECT_EQ(
        parse_study(with(constant_machine, "damping = \"400 N s/m\"", std::string("damping_ratio = ") + ratio), "m")
            .parameters.balls,
        2)
        << ratio;
}

TEST(DataSheet, RefusesOilsThatItDoesNotKnow) {
  const auto said = [&](const std::string& oil) {
    return refusal_of(oiled, {"balancer.ball_material=steel", "balancer.oil=" + oil});
  };
  const auto expect = [&](const std::string& oil, const std::string& words) {
    EXPECT_TRUE(holds(said(oil), words)) << said(oil);
  };
  expect("{ grade = 'ISO VG 33', at = '40 degC' }", "did you mean \"ISO VG 32\"?");
  expect("{ grade = 'SAE 10W-30', at = '40 degC' }", "grade = \"SAE 10W-30\": must be \"ISO VG\"");
  expect("{ grade = 'olive', at = '40 degC' }", "must be \"ISO VG\" with a class of ISO 3448 from 2 to 3200");
  expect("{ grade = 'silicone', at = '40 degC' }", "must be \"ISO VG\"");
  expect("{ grade = 'silicone 5 cSt', at = '40 degC' }", "from 100 to 100000 cSt");
  expect("{ grade = 'ISO VG 5', at = '40 degC' }", "give viscosity_100");
  expect("{ grade = 'ISO VG 32', at = '40 degC', viscosity_100 = '40 cSt' }",
         "less than the viscosity at 40 degC, 32 cSt");
  expect("{ grade = 'silicone 1000 cSt', at = '25 degC', viscosity_100 = '40 cSt' }", "applies to mineral oils only");
  expect("{ grade = 'ISO VG 32', at = '-60 degC' }", "must be from -20 to 150 degC");
  expect("{ grade = 'ISO VG 32', at = '300 degC' }", "must be from -20 to 150 degC");
  expect("{ grade = 'ISO VG 32', at = 40 }", "must be a temperature greater than 0, such as \"40 degC\"");
  expect("{ grade = 'ISO VG 32' }", "balancer.oil.at: missing");
  expect("{ at = '40 degC' }", "balancer.oil.grade: missing");
  EXPECT_TRUE(holds(refusal_of(sheet, {"balancer.oil_density=900 kg/m3"}), "only with balancer.oil_viscosity or"));
}

TEST(DataSheet, RefusesBallsTooCloseToTheirChannel) {
  const Overrides oil{"balancer.ball_material=steel", "balancer.oil={ grade = 'ISO VG 32', at = '40 degC' }"};
  const auto with_channel = [&](const std::string& channel) {
    Overrides all = oil;
    all.push_back("balancer.channel_diameter=" + channel);
    return all;
  };
  EXPECT_NEAR(parse_sheet(oiled, with_channel("10 mm")).parameters.drag[0] / parse_sheet(oiled, oil).parameters.drag[0],
              74.67, 0.002 * 74.67);
  EXPECT_TRUE(holds(refusal_of(oiled, with_channel("9.9 mm")),
                    "must be at least 10 mm: the wall correction holds for balls up to 0.8 of the channel; in a closer "
                    "fit measure the drag and state balancer.drag"));
}

// Unbalance in places.

std::string place(const std::string& mass, const std::string& radius, const std::string& angle) {
  return fmt::format("[[place]]\nmass = {}\nradius = {}\nangle = {}\n", mass, radius, angle);
}

TEST(Places, AddAsVectorsToTheRotorsOwnUnbalance) {
  const std::string two =
      place("\"10 g\"", "\"100 mm\"", "\"90 degree\"") + place("\"4 g\"", "\"50 mm\"", "\"200 degree\"");
  const std::complex<double> places = std::polar(1e-3, pi / 2.0) + std::polar(2e-4, 200.0 * pi / 180.0);
  const auto eccentricity = [](const std::string& text, const Overrides& o = {}) {
    return parse_sheet(text, o).parameters.eccentricity;
  };
  EXPECT_NEAR(eccentricity(sheet + two), std::abs(2.4e-3 + places) / 12.0 / 0.03, 1e-15);
  const std::string bare = sheet_with("eccentricity = \"0.2 mm\"\n", "");
  EXPECT_NEAR(eccentricity(bare + two), std::abs(places) / 12.0 / 0.03, 1e-15);
  EXPECT_NEAR(eccentricity(bare + two, {"rotor.unbalance=600 g mm"}), std::abs(6e-4 + places) / 12.0 / 0.03, 1e-15);
  EXPECT_NEAR(eccentricity(bare + two, {"rotor.balance_grade={grade='G 6.3', at='3000 rpm'}"}),
              std::abs(12.0 * 6.3e-3 / (100.0 * pi) + places) / 12.0 / 0.03, 1e-15);
  EXPECT_NEAR(eccentricity(bare + two, {"place.2.mass=8 g"}),
              std::abs(places + std::polar(2e-4, 200.0 * pi / 180.0)) / 12.0 / 0.03, 1e-15);
  EXPECT_FALSE(holds(to_toml(parse_sheet(sheet + two)), "place"));
}

// x of the model points along the resultant, so that what is fixed to the rotor turns by its angle.
TEST(Places, TurnTheOffsetOfTheRace) {
  const std::string bare = sheet_with("eccentricity = \"0.2 mm\"\n", "");
  const Study s =
      parse_sheet(bare + place("\"10 g\"", "\"100 mm\"", "\"90 degree\""), {"balancer.race_offset=['30 um', '0 um']"});
  EXPECT_NEAR(s.parameters.race_offset[0], 0.0, 1e-18);
  EXPECT_NEAR(s.parameters.race_offset[1], -0.001, 1e-15);
}

TEST(Places, MayBeUncertain) {
  const std::string text =
      sheet + place("{uniform=[\"0 g\", \"20 g\"]}", "\"100 mm\"", "{uniform=[\"0 degree\", \"360 degree\"]}") +
      place("\"1 g\"", "{values=[\"50 mm\", \"60 mm\"]}", "0.5");
  // A mass of 0 is no mass.
  EXPECT_TRUE(holds(refusal_of(text), "place.1.mass"));
  const Study s = parse_sheet(with(text, "\"0 g\"", "\"1 g\""));
  ASSERT_EQ(s.uncertain.values.size(), 3u);
  EXPECT_EQ(s.uncertain.values[0].key, "place.1.angle");
  EXPECT_EQ(s.uncertain.values[2].key, "place.2.radius");
  const Study drawn = drawn_study(s, std::vector{90.0, 5.0, 60.0});
  EXPECT_NEAR(drawn.parameters.eccentricity,
              std::abs(2.4e-3 + std::polar(5e-4, pi / 2.0) + std::polar(6e-5, 0.5)) / 12.0 / 0.03, 1e-15);
  EXPECT_NO_THROW(check(s));
  EXPECT_TRUE(holds(to_toml(s), "[[place]]\nangle = ")) << to_toml(s);
  EXPECT_EQ(first_difference(s, parse_sheet(to_toml(s))), "");
}

TEST(Places, FromATreeAreThoseOfTheText) {
  StudyValue tree{{"rotor", {{"mass", "12 kg"}, {"stiffness", "48 kN/m"}, {"damping", "400 N s/m"}}},
                  {"place", StudyValue::Array{{{"mass", "10 g"}, {"radius", "100 mm"}, {"angle", "90 degree"}}}},
                  {"balancer", {{"balls", 2}, {"race_radius", "30 mm"}, {"mass", "60 g"}, {"drag", "2e-4 N m s"}}},
                  {"speed", {{"profile", "constant"}, {"speed", "2000 rpm"}}}};
  EXPECT_NEAR(study_from(tree).parameters.eccentricity, 1e-3 / 12.0 / 0.03, 1e-15);
}

TEST(Places, SayWhatIsWrong) {
  const std::string good = place("\"10 g\"", "\"100 mm\"", "\"90 degree\"");
  const auto expect = [&](const std::string& text, const std::string& words, const Overrides& o = {}) {
    EXPECT_TRUE(holds(refusal_of(text, o), words)) << refusal_of(text, o);
  };
  expect(sheet + good + place("\"10 g\"", "\"100 mm\"", "\"9 kg\""), "place.2.angle = \"9 kg\"");
  expect(sheet + with(good, "radius", "raduis"), "place.1.raduis = \"100 mm\": unknown key; did you mean \"radius\"?");
  expect(sheet + with(good, "angle = \"90 degree\"\n", ""), "place.1.angle: missing; must be an angle");
  expect(sheet + place("\"13 kg\"", "\"100 mm\"", "0.0"), "must be greater than that of all places, 13 kg");
  expect(sheet + "[place]\nmass = \"1 g\"\n", "must be an array of tables, each begun by [[place]]");
  expect(sheet + good, "place has entries place.1 to place.1", {"place.2.mass=1 g"});
  expect(sheet + with(good, "[[place]]", "[[plaec]]"), "did you mean \"place\"?");
  expect(with(sheet, "[balancer]", "[balancr]"), "did you mean \"balancer\"?");
  expect(constant_speed + good, "rotor.mass: missing");
  EXPECT_EQ(refusal_of(sheet + good + "name = \"the lump\"\n"), "");
  expect(sheet + good + "name = 3\n", "place.1.name = 3: is a number; must be a text in quotes");
}

TEST(Typos, InValuesAreSeen) {
  const auto said = [&](const std::string& from, const std::string& to) { return refusal_of(sheet_with(from, to)); };
  EXPECT_TRUE(holds(said("\"ramp\"", "\"rmap\""),
                    "did you mean \"ramp\"? must be one of: constant, ramp, trapezoid, points, hill, torque"));
  EXPECT_FALSE(holds(said("\"ramp\"", "\"sawtooth\""), "did you mean"));
  EXPECT_TRUE(holds(said("48 kN/m", "48 kn/m"), "(did you mean \"kN\"?)"));
}

}  // namespace data_sheet_study_test
}  // namespace equipoise
