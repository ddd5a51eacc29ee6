// Uncertain values: what distributions draw, what of a start stays when values are drawn too, what is refused, and
// studies read, echoed and drawn.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../support/studies.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/study/contents/study.hpp"
#include "../support/study_difference.hpp"

namespace equipoise {
namespace uncertain_test {

constexpr std::uint64_t draws = 100000;

Study study_with(const std::vector<std::string>& overrides) { return parse_study(constant_speed, "study", overrides); }

// In physical units, as an engineer would write it.
const std::string machine = R"([rotor]
mass = "12 kg"
stiffness = "48 kN/m"
damping_ratio = 0.2
unbalance = "200 g mm"
[balancer]
balls = 2
race_radius = "120 mm"
mass = "6 g"
drag = "1e-5 N m s"
[speed]
profile = "ramp"
final = "1500 rpm"
duration = "10 s"
)";

Study machine_with(const std::vector<std::string>& overrides) { return parse_study(machine, "machine", overrides); }

// Draws of a study's only uncertain value.
std::vector<double> drawn(const Study& study, std::uint64_t count = draws) {
  const Sampler sampler = sampler_of(study);
  std::vector<double> values;
  for (std::uint64_t i = 0; i < count; ++i) values.push_back(drawn_values(study, sampler, 1, i).front());
  return values;
}

struct Moments {
  double mean = 0.0, deviation = 0.0;
};
Moments moments(const std::vector<double>& values) {
  Moments m;
  for (const double v : values) m.mean += v / static_cast<double>(values.size());
  for (const double v : values) m.deviation += (v - m.mean) * (v - m.mean) / static_cast<double>(values.size());
  m.deviation = std::sqrt(m.deviation);
  return m;
}

// Four standard errors of a mean of this many draws; those of a deviation are no larger for the laws used here.
double four_errors(double deviation) { return 4.0 * deviation / std::sqrt(static_cast<double>(draws)); }

TEST(Uncertain, UniformDrawsHaveItsMomentsAndBounds) {
  const auto values = drawn(study_with({"rotor.eccentricity={uniform=[0.005, 0.015]}"}));
  const double deviation = 0.01 / std::sqrt(12.0);
  EXPECT_NEAR(moments(values).mean, 0.01, four_errors(deviation));
  EXPECT_NEAR(moments(values).deviation, deviation, four_errors(deviation));
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  EXPECT_GE(*low, 0.005);
  EXPECT_LE(*high, 0.015);
}

TEST(Uncertain, NormalDrawsHaveItsMoments) {
  const auto values = drawn(study_with({"balancer.drag={normal=[0.05, 0.004]}"}));
  EXPECT_NEAR(moments(values).mean, 0.05, four_errors(0.004));
  EXPECT_NEAR(moments(values).deviation, 0.004, four_errors(0.004));
}

TEST(Uncertain, CutNormalDrawsStayBetweenAndHaveTheMeanOfWhatIsLeft) {
  // Of a standard normal law above 1: mean phi(1)/(1 - Phi(1)) = 1.5251 (standard tables: phi(1) = 0.24197, 1 - Phi(1)
  // = 0.15866); its deviation is below that of the whole law.
  const auto values = drawn(study_with({"balancer.drag={normal=[0.05, 0.01], between=[0.06, 0.2]}"}));
  EXPECT_GE(*std::min_element(values.begin(), values.end()), 0.06);
  EXPECT_NEAR(moments(values).mean, 0.05 + 0.01 * 1.5251, four_errors(0.01) + 1e-6);
}

TEST(Uncertain, FarTailsOfANormalLawAreDrawnToo) {
  // Above 10 deviations a normal law falls like an exponential of rate 10: mean 10.098.
  const auto values = drawn(study_with({"balancer.drag={normal=[0.05, 0.01], between=[0.15, 1.0]}"}));
  EXPECT_NEAR(moments(values).mean, 0.05 + 0.01 * 10.098, four_errors(0.001) + 1e-5);
}

TEST(Uncertain, LogUniformDrawsAreEvenInTheirLogarithm) {
  auto values = drawn(study_with({"balancer.drag={loguniform=[0.01, 1.0]}"}));
  for (double& v : values) v = std::log10(v);
  EXPECT_NEAR(moments(values).mean, -1.0, four_errors(2.0 / std::sqrt(12.0)));
  EXPECT_NEAR(moments(values).deviation, 2.0 / std::sqrt(12.0), four_errors(2.0 / std::sqrt(12.0)));
}

TEST(Uncertain, ListsDrawEachEntryAlike) {
  const auto values = drawn(study_with({"balancer.drag={values=[0.05, 0.1, 0.2]}"}));
  for (const double v : {0.05, 0.1, 0.2}) {
    const auto count = static_cast<double>(std::count(values.begin(), values.end(), v));
    const double share = 1.0 / 3.0, error = std::sqrt(share * (1.0 - share) / static_cast<double>(draws));
    EXPECT_NEAR(count / static_cast<double>(draws), share, 4.0 * error) << v;
  }
}

// The middle of a whole turn would be opposite the rotor's own unbalance.
TEST(Uncertain, AnglesDrawnAllRoundAreTakenAtAQuarterTurn) {
  const auto taken = [](const std::string& angle) {
    return parse_study(ramp_machine + "[[place]]\nmass = '10 g'\nradius = '20 mm'\nangle = " + angle, "m");
  };
  const auto same = [&](const std::string& drawn, const std::string& angle) {
    EXPECT_NEAR(taken(drawn).parameters.eccentricity, taken(angle).parameters.eccentricity, 1e-15) << drawn;
    EXPECT_NO_THROW(check(taken(drawn)));
  };
  same("{ uniform = ['0 degree', '360 degree'] }", "'90 degree'");
  same("{ uniform = ['-180 degree', '180 degree'] }", "'90 degree'");
  same("{ uniform = ['0 rad', '6.2 rad'] }", "'90 degree'");
  same("{ values = ['0 degree', '120 degree', '240 degree'] }", "'90 degree'");
  // These have a direction.
  same("{ uniform = ['100 degree', '200 degree'] }", "'150 degree'");
  same("{ normal = ['180 degree', '20 degree'] }", "'180 degree'");
}

TEST(Uncertain, StudyHoldsTheMedians) {
  EXPECT_DOUBLE_EQ(study_with({"rotor.eccentricity={uniform=[0.005, 0.02]}"}).parameters.eccentricity, 0.0125);
  EXPECT_DOUBLE_EQ(study_with({"balancer.drag={loguniform=[0.01, 1.0]}"}).parameters.drag[1], 0.1);
  EXPECT_DOUBLE_EQ(study_with({"balancer.drag={normal=[0.05, 0.001]}"}).parameters.drag[0], 0.05);
  EXPECT_DOUBLE_EQ(study_with({"speed.speed={values=[3.0, 2.0, 2.4]}"}).speed.speed, 2.4);
}

TEST(Uncertain, AnglesOfStartsStayWhateverElseIsDrawn) {
  const std::vector<std::string> one{"rotor.eccentricity={uniform=[0.005, 0.015]}"};
  const std::vector<std::string> two{one[0], "balancer.drag={uniform=[0.04, 0.06]}"};
  for (const char* method : {"random", "sobol", "grid"}) {
    const std::string with = fmt::format("sampling.method={}", method);
    const Study plain = study_with({with}), first = study_with({with, one[0]}),
                second = study_with({with, two[0], two[1]});
    for (std::uint64_t i = 0; i < 200; ++i) {
      const auto phi = start_of(plain, 7, i).phi;
      EXPECT_EQ(start_of(first, 7, i).phi, phi) << method;
      EXPECT_EQ(start_of(second, 7, i).phi, phi) << method;
      // Numbers belong to keys, but those of a Sobol point to places.
      if (std::string(method) == "sobol") continue;
      EXPECT_EQ(drawn_values(first, sampler_of(first), 7, i)[0], drawn_values(second, sampler_of(second), 7, i)[1]);
    }
  }
}

TEST(Uncertain, DrawsAreIndependentOfAnglesOfEachOtherAndOfTheSeed) {
  const Study study = study_with({"rotor.eccentricity={uniform=[0.0, 1.0]}", "balancer.drag={uniform=[0.0, 1.0]}"});
  const Sampler sampler = sampler_of(study);
  double with_angle = 0.0, with_each_other = 0.0, with_seed = 0.0;
  for (std::uint64_t i = 0; i < draws; ++i) {
    const auto values = drawn_values(study, sampler, 1, i), other = drawn_values(study, sampler, 2, i);
    const double angle = start_of(study, 1, i).phi[0] / two_pi;
    with_angle += (values[0] - 0.5) * (angle - 0.5);
    with_each_other += (values[0] - 0.5) * (values[1] - 0.5);
    with_seed += (values[0] - 0.5) * (other[0] - 0.5);
  }
  // The product of two independent centred fractions has the deviation 1/12.
  for (const double sum : {with_angle, with_each_other, with_seed})
    EXPECT_NEAR(sum / static_cast<double>(draws), 0.0, four_errors(1.0 / 12.0));
}

TEST(Uncertain, SobolPointsSpreadTheDrawsEvenly) {
  const Study study = study_with({"rotor.eccentricity={uniform=[0.0, 1.0]}", "sampling.method=sobol"});
  auto values = drawn(study, 4096);  // 16 replicates of 256 points
  std::array<int, 256> hits{};
  for (const double v : values) ++hits[static_cast<std::size_t>(v * 256.0)];
  for (const int n : hits) EXPECT_EQ(n, 16);  // a net: one point of each replicate in every interval of 1/256
}

TEST(Uncertain, ADrawIsTheStudyOfItsValues) {
  const Study study = study_with({"rotor.eccentricity={uniform=[0.005, 0.015]}", "speed.speed={values=[2.0, 2.4]}"});
  const std::array values{0.012, 2.0};
  const Study draw = drawn_study(study, values);
  EXPECT_EQ(first_difference(draw, study_with({"rotor.eccentricity=0.012", "speed.speed=2.0"})), "");
}

// Of a tilting rotor, with places for whatever tables and keys are to be drawn.
const std::string tilting = R"([rotor]
eccentricity = 0.01
damping = 0.5
gravity = 0.01
tilt = { transverse_inertia = 3.0, polar_inertia = 1.0, stiffness = [0.0, 3.0], damping = [0.0, 1.5] }
[balancer]
balls = 2
mass = 0.05
drag = 0.05
plane = [-0.5, 0.5]
[speed]
profile = "constant"
speed = 2.4
)";
const std::string motor =
    rotor_and_balancer + "[speed]\nprofile = \"torque\"\ntorque = { stall = 0.2, no_load_speed = 3.0 }\n";

// No draw is read, and each is what reading its values gives: also what follows from them by default.
const std::string controlled =
    with(rotor_and_balancer, "damping = 0.5", "damping = 0.5\ninertia = 0.5") +
    "[speed]\nprofile = \"torque\"\n[speed.torque]\ngain = 0.5\n[speed.torque.target]\nprofile = \"ramp\"\n"
    "final = 2.4\nduration = 50.0\n";

TEST(Uncertain, ADrawIsWhatReadingItsValuesGives) {
  struct Case {
    std::string toml, key, drawn, other;
  };
  const std::vector<Case> cases{{constant_speed, "rotor.damping", "0.5, 0.6", "0.55"},
                                {constant_speed, "balancer.mass", "0.05, 0.06", "0.0525"},
                                {constant_speed, "balancer.rolling", "0.001, 0.002", "0.0015"},
                                {ramp_speed, "speed.duration", "400, 600", "450.0"},
                                {tilting, "rotor.gravity", "0.0, 0.02", "0.015"},
                                {tilting, "rotor.tilt.polar_inertia", "1, 2", "1.5"},
                                {tilting, "rotor.eccentricity_angle", "0, 1", "0.25"},
                                {motor, "speed.torque.stall", "0.1, 0.2", "0.15"},
                                {motor, "speed.load.constant", "0.0, 0.02", "0.015"},
                                {motor, "speed.load.constant", "0.0, 0.0, 0.02", "0.015"},
                                {controlled, "speed.torque.target.final", "2.0, 2.4", "2.2"}};
  for (const auto& [toml, key, drawn, other] : cases) {
    const std::vector<std::string> inertia{toml == motor ? "rotor.inertia=0.5" : "rotor.stiffness=1.0"};
    const auto with_value = [&](const std::string& value) {
      return parse_study(toml, "study", {inertia[0], fmt::format("{}={}", key, value)});
    };
    const Study study = with_value(fmt::format("{{ values = [{}] }}", drawn));
    const std::array values{number_in(other)};
    EXPECT_EQ(first_difference(drawn_study(study, values), with_value(other)), "") << key;
    EXPECT_NO_THROW(check(study)) << key;
    EXPECT_EQ(to_toml(parse_study(to_toml(study), "echo")), to_toml(study)) << key;
  }
}

TEST(Uncertain, PercentagesAreDrawnAsPercentages) {
  const Study study = study_with({"balancer.restitution={uniform=['40 %', '60 %']}"});
  EXPECT_EQ(drawn_study(study, std::array{45.0}).parameters.restitution, 0.45);
}

TEST(Uncertain, DrawsBeyondTheEndsThatMakeNoStudyAreRefused) {
  const auto refusal = [](const Study& study, double value) {
    try {
      drawn_study(study, std::array{value});
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(study_with({"rotor.eccentricity={normal=[0.01, 0.001]}"}), -0.001),
            "study: rotor.eccentricity = -0.001: must be a finite number at least 0");
  EXPECT_NE(refusal(study_with({"balancer.rolling={normal=[0.01, 0.001]}", "balancer.stiction=0.02"}), 0.03), "");
  EXPECT_NE(refusal(parse_study(tilting, "t", {"rotor.tilt.polar_inertia={normal=[1, 0.1]}"}), 7.0), "");
  EXPECT_NE(refusal(parse_study(tilting, "t", {"rotor.tilt.transverse_inertia={normal=[3, 0.1]}"}), 0.0), "");
  EXPECT_NE(refusal(parse_study(ramp_speed, "r", {"release.speed={normal=[2, 0.01]}"}), 2.5), "");
}

TEST(Uncertain, AQuantityChangesAllThatFollowsFromIt) {
  const Study study = machine_with({"balancer.mass={uniform=[\"5 g\", \"7 g\"]}"});
  const std::array values{5.5};
  // The ball's drag over its mass, and everything else, as if this mass had been written.
  EXPECT_EQ(first_difference(drawn_study(study, values), machine_with({"balancer.mass=5.5 g"})), "");
  EXPECT_NE(drawn_study(study, values).parameters.drag[0], study.parameters.drag[0]);
}

TEST(Uncertain, EachDrawRestsUnderItsOwnWeightAtFirst) {
  const Study study = study_with({"rotor.gravity={uniform=[0.0, 0.1]}"});
  const std::array values{0.08};
  EXPECT_EQ(drawn_study(study, values).initial.y, study_with({"rotor.gravity=0.08"}).initial.y);
}

TEST(Uncertain, EchoReadsBackToTheStudyAndToItself) {
  const std::vector<Study> studies{
      study_with(
          {"rotor.eccentricity={uniform=[0.005, 0.015]}", "balancer.drag={normal=[0.05, 0.01], between=[0.01, 0.1]}"}),
      study_with({"rotor.gravity={values=[0.0, 0.1]}", "balancer.mass={loguniform=[0.01, 0.1]}"}),
      study_with({"balancer.rolling={uniform=[0.001, 0.002]}"}),
      study_with({"speed={profile=\"torque\", torque={stall={uniform=[0.05, 0.06]}, no_load_speed=2.4}}",
                  "rotor.inertia=0.5"}),
      machine_with({"rotor.unbalance={uniform=[\"100 g mm\", \"400 g mm\"]}", "numerics.horizon=100 s"}),
      machine_with(
          {"rotor.mass={normal=[\"12 kg\", \"0.1 kg\"]}", "balancer.drag={values=[\"1e-5 N\\u00b7m\\u00b7s\"]}"}),
  };
  for (const Study& study : studies) {
    const std::string echo = to_toml(study);
    const Study back = parse_study(echo, "echo");
    EXPECT_EQ(first_difference(study, back), "") << echo;
    EXPECT_EQ(to_toml(back), echo);
    EXPECT_NO_THROW(check(study));
    EXPECT_EQ(to_toml(with_medians(study)).find("uniform"), std::string::npos);
  }
}

TEST(Uncertain, WhatIsSampledAndFollowedMayChangeAfterReading) {
  Study study = machine_with({"rotor.unbalance={uniform=[\"100 g mm\", \"400 g mm\"]}"});
  study.sampling.starts = 77;
  study.numerics.horizon = 4000.0;
  const Study back = parse_study(to_toml(study), "echo");
  EXPECT_EQ(back.sampling.starts, 77u);
  EXPECT_NEAR(*back.numerics.horizon, 4000.0, 4000.0 * 4e-16);  // there and back by omega_c: one rounding each
  EXPECT_NO_THROW(check(study));
  study.parameters.eccentricity *= 2.0;  // its draws would not show it
  EXPECT_THROW(check(study), InputError);
}

}  // namespace uncertain_test
}  // namespace equipoise
